// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Prints answers of Bch.cs, which answers.py prints with the Python package: the same bits are the same lines.

using System;
using System.Linq;
using System.Runtime.InteropServices;
using Bch;

static class Answers
{
    static long state = 12345;
    static double Random()
    {
        state = (state * 1103515245 + 12345) & 0x7fffffff;
        return state / (double)0x7fffffff;
    }
    static T[] Many<T>(int count, Func<int, T> of) { return Enumerable.Range(0, count).Select(of).ToArray(); }

    /// FNV-1a of the bytes of an array.
    static string Hash<T>(T[] values) where T : struct
    {
        var handle = GCHandle.Alloc(values, GCHandleType.Pinned);
        var bytes = new byte[values.Length * Marshal.SizeOf(typeof(T))];
        if (bytes.Length > 0) Marshal.Copy(handle.AddrOfPinnedObject(), bytes, 0, bytes.Length);
        handle.Free();
        uint hash = 0x811c9dc5;
        foreach (byte each in bytes) hash = (hash ^ each) * 0x01000193;
        return hash.ToString("x");
    }
    static void Require(bool holds, string what)
    {
        if (!holds) throw new Exception("expected " + what);
    }
    static void RequireError(string words, Action act)
    {
        try { act(); }
        catch (Exception error)
        {
            Require(error.Message.Contains(words), "'" + words + "', found '" + error.Message + "'");
            return;
        }
        throw new Exception("expected an error: " + words);
    }

    static void Crowds()
    {
        const int n = 600;
        var people = ShapeSet.Bake(new[] { Character.Male(), Character.Female() }, 20);
        var agents = new Agents(n);
        for (int i = 0; i < n; ++i) agents.Shape[i] = (uint)(Random() * 40);
        foreach (var values in new[] { agents.X, agents.Y })
            for (int i = 0; i < n; ++i) values[i] = Random() * 14;
        for (int i = 0; i < n; ++i) agents.Heading[i] = Random() * 6;
        var crowd = new Crowd();
        var pairs = crowd.Collisions(people, agents);
        Console.WriteLine("shapes {0}, collisions {1} {2}", people.Count, pairs.Length, Hash(pairs));
        Pair[] room = null;
        Penetration[] depths = null;
        int count = crowd.Penetrations(people, agents, ref room, ref depths);
        Console.WriteLine("penetrations {0} {1}", count, Hash(depths.Take(count).Select(each => each.Depth).ToArray()));
        var before = room;
        Require(crowd.Collisions(people, agents, ref room) == pairs.Length && room == before, "an array of enough room to be kept");
        agents.X[3] = double.NaN;
        RequireError("agent 3", () => crowd.Collisions(people, agents));
        RequireError("Z: expected 600 values, found 1", () => { agents.Z = new double[1]; crowd.Collisions(people, agents); });
        people.Dispose();
        people.Dispose();
        RequireError("ShapeSet", () => crowd.Collisions(people, agents));
    }

    static void Bodies()
    {
        const int n = 400;
        var models = new[] { BodyModel.Default(Character.Pedestrian(false, 1.78), 64), BodyModel.Default(Character.Pedestrian(true, 1.66), 128) };
        var bodies = new LiveBodies(models, Many(n, i => (uint)(i % 2)));
        bodies.Pose(Many(n, i => (uint)(30 + i % 20)), Many(n, i => i / 512f));
        var agents = new Agents(n) { Z = new double[n] };
        for (int i = 0; i < n; ++i) Unity.Place(agents, i, i % 20 * 0.45f, i % 3 * 0.25f, i / 20 * 0.5f, 7 * i);
        var crowd = new Crowd(12, 12);
        var pairs = crowd.Collisions(bodies, agents);
        Console.WriteLine("bodies {0} {1} {2}", bodies.Count, pairs.Length, Hash(pairs));
        Console.WriteLine("spheres {0} {1}", Hash(bodies.Spheres(0)), Hash(bodies.Spheres(1)));
        RequireError("seconds: expected 400 values, found 1", () => bodies.Pose(new uint[n], new float[1]));
    }

    /// A box of one bone in Unity's axes, moved by Unity's matrices, is where Unity's axes say.
    static void OwnBody()
    {
        float[] corners = { 0, 0, 0, 0.4f, 0, 0, 0, 0, 0.6f, 0, 1.8f, 0 };
        uint[] triangles = { 0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2 };
        Unity.Points(corners);
        Unity.Triangles(triangles);
        float[] identity = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
        var weights = Many(16, i => i % 4 == 0 ? 1f : 0);
        var box = Character.Skinned(corners, triangles, new uint[16], weights, new[] { -1 }, identity, identity);
        Require(box.Joints == 1 && box.Clips == 0, "one joint, no clip");
        var bodies = new LiveBodies(new[] { BodyModel.Make(box, 8, true) }, new uint[] { 0, 0 });
        // In columns: the second stands 3 m to the right, 1 m up and 2 m ahead, turned by 90 degrees to the right.
        float[] matrices = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 3, 1, 2, 1 };
        Unity.Transforms(matrices);
        bodies.Pose(matrices);
        Sphere first = bodies.Spheres(0)[0], second = bodies.Spheres(1)[0];
        // Ours are ahead, left and up; a quarter turn to the right takes ahead to right, and left to ahead.
        Require(Math.Abs(second.X - (2 + first.Y)) < 1e-5 && Math.Abs(second.Y - (-3 - first.X)) < 1e-5 && Math.Abs(second.Z - (1 + first.Z)) < 1e-5,
            "a sphere where Unity's matrix puts it, found (" + second.X + ", " + second.Y + ", " + second.Z + ")");
        RequireError("transforms: expected 16 floats", () => bodies.Pose(new float[17]));
        RequireError("weights: expected 16", () => Character.Skinned(corners, triangles, new uint[16], new float[4], new[] { -1 }, identity, identity));
    }

    static void Main()
    {
        Console.WriteLine("version {0}", Library.Version);
        Crowds();
        Bodies();
        OwnBody();
        RequireError("", () => ShapeSet.Load(new byte[10], "ten bytes"));
    }
}
