// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Collision checks between characters in dense crowds, for .NET, Mono and Unity: a thin layer over the C interface, bch.h, which says more of each
// call. One file to copy; it calls the native library `bch` (libbch.so, bch.dll), which stands beside the program or among a project's plug-ins.
//
// Lengths are in metres, angles in radians, counter-clockwise seen from above; x and y are on the ground, z is up. See class Unity for others.

using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Bch
{
    /// <summary>An error of the library. The message names the argument, an index and the value.</summary>
    public sealed class BchException : Exception
    {
        public BchException(string message) : base(message) { }
    }

    /// <summary>Two agents, by index.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Pair
    {
        public uint First, Second;
        public override string ToString() { return "(" + First + ", " + Second + ")"; }
    }

    /// <summary>A ball, metres.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Sphere
    {
        public float X, Y, Z, Radius;
    }

    /// <summary>How far the first agent of a pair has to move, metres, and the direction of the move, a unit vector.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Penetration
    {
        public float Depth;
        private float unused;
        public double X, Y;
    }

    /// <summary>The form in which you pass poses.</summary>
    public enum PoseKind
    {
        /// <summary>The transforms of all joints, each in the frame of its parent.</summary>
        JointsInParents = 0,
        /// <summary>The transforms of all joints to the ground.</summary>
        JointsInWorld = 1,
        /// <summary>Those of a renderer, for all bones: the joint's transform to the ground times its inverse bind matrix.</summary>
        BoneMatrices = 2
    }

    /// <summary>A library's object, freed by Dispose() or with the last reference.</summary>
    public abstract class NativeObject : IDisposable
    {
        private readonly Func<IntPtr, int> free;
        private IntPtr pointer;

        internal NativeObject(IntPtr pointer, Func<IntPtr, int> free)
        {
            this.pointer = pointer;
            this.free = free;
        }
        ~NativeObject() { Free(); }
        public void Dispose()
        {
            Free();
            GC.SuppressFinalize(this);
        }
        private void Free()
        {
            if (pointer != IntPtr.Zero && free != null) free(pointer);
            pointer = IntPtr.Zero;
        }
        internal IntPtr Pointer
        {
            get
            {
                if (pointer == IntPtr.Zero) throw new ObjectDisposedException(GetType().Name);
                return pointer;
            }
        }
    }

    /// <summary>A mesh on a skeleton, with clips.</summary>
    public sealed class Character : NativeObject
    {
        private Character(IntPtr pointer) : base(pointer, Native.bch_character_free) { }
        public static Character Male() { return Default(0); }
        public static Character Female() { return Default(1); }
        private static Character Default(int which)
        {
            IntPtr made;
            Native.Check(Native.bch_character_default(which, out made));
            return new Character(made);
        }
        /// <summary>A person who walks: clip k is one stride at 0.03 k metres per second.</summary>
        public static Character Pedestrian(bool isFemale, double stature, double shoulders = 0)
        {
            IntPtr made;
            Native.Check(Native.bch_character_pedestrian(isFemale ? 0 : 1, stature, shoulders, out made));
            return new Character(made);
        }
        /// <summary>A mesh that bones move: three floats a vertex and three indices a triangle; four bones and four weights a vertex, as Unity has
        /// them, of which those of weight 0 do not count; and for each bone its parent, an earlier one or -1, and 12 floats a transform, three rows:
        /// the bone's rest transform in its parent's frame and its inverse bind matrix. Everything is in metres, z up: see class Unity.</summary>
        public static Character Skinned(float[] vertices, uint[] triangles, uint[] bones, float[] weights, int[] parents, float[] rests, float[] inverseBinds)
        {
            int count = vertices.Length / 3;
            Expect("bones", 4 * count, bones.Length);
            Expect("weights", 4 * count, weights.Length);
            Expect("rests", 12 * parents.Length, rests.Length);
            Expect("inverseBinds", 12 * parents.Length, inverseBinds.Length);
            var offsets = new ulong[count + 1];
            var influences = new List<Influence>();
            for (int v = 0; v < count; ++v)
            {
                double sum = 0;
                for (int k = 4 * v; k < 4 * v + 4; ++k) sum += Math.Max(0, weights[k]);
                for (int k = 4 * v; k < 4 * v + 4; ++k)
                    if (weights[k] > 0) influences.Add(new Influence { bone = bones[k], weight = (float)(weights[k] / sum) });
                offsets[v + 1] = (ulong)influences.Count;
            }
            var joints = new uint[parents.Length];
            for (uint i = 0; i < joints.Length; ++i) joints[i] = i;
            using (var pinned = new Pins())
            {
                var arrays = new CharacterArrays
                {
                    root_joint = 0,
                    vertices = pinned.At(vertices), vertex_count = (UIntPtr)count,
                    triangles = pinned.At(triangles), triangle_count = (UIntPtr)(triangles.Length / 3),
                    parents = pinned.At(parents), rests = pinned.At(rests), joint_count = (UIntPtr)parents.Length,
                    bone_joints = pinned.At(joints), inverse_binds = pinned.At(inverseBinds), bone_count = (UIntPtr)parents.Length,
                    influence_offsets = pinned.At(offsets), influences = pinned.At(influences.ToArray())
                };
                arrays.size = (uint)Marshal.SizeOf(arrays);
                IntPtr made;
                Native.Check(Native.bch_character_create(ref arrays, out made));
                return new Character(made);
            }
        }
        public uint Clips { get { return Info.clips; } }
        public uint Joints { get { return Info.joints; } }
        private CharacterInfo Info
        {
            get
            {
                var info = new CharacterInfo();
                info.size = (uint)Marshal.SizeOf(info);
                Native.Check(Native.bch_character_get_info(Pointer, ref info));
                GC.KeepAlive(this);
                return info;
            }
        }
        internal static void Expect(string name, int expected, int found)
        {
            if (expected != found) throw new ArgumentException(name + ": expected " + expected + " values, found " + found);
        }
    }

    /// <summary>Shapes of bodies as seen from above.</summary>
    public sealed class ShapeSet : NativeObject
    {
        private ShapeSet(IntPtr pointer) : base(pointer, Native.bch_shape_set_free) { }
        /// <summary>Makes a set of characters, each in so many poses that are spread evenly over its clips.</summary>
        public static ShapeSet Bake(Character[] characters, int poses)
        {
            IntPtr made;
            Native.Check(Native.bch_bake(Native.Pointers(characters), (UIntPtr)characters.Length, (uint)poses, IntPtr.Zero, IntPtr.Zero, out made));
            GC.KeepAlive(characters);
            return new ShapeSet(made);
        }
        /// <summary>Reads what the program `bch bake` wrote.</summary>
        public static ShapeSet Load(byte[] bytes, string name = "bytes")
        {
            IntPtr made;
            Native.Check(Native.bch_shape_set_load_bytes(bytes, (UIntPtr)bytes.Length, name, out made));
            return new ShapeSet(made);
        }
        public uint Count
        {
            get
            {
                var info = new ShapeSetInfo();
                info.size = (uint)Marshal.SizeOf(info);
                Native.Check(Native.bch_shape_set_get_info(Pointer, ref info));
                GC.KeepAlive(this);
                return info.shapes;
            }
        }
    }

    /// <summary>Spheres on a skeleton that hold the skin in every pose.</summary>
    public sealed class BodyModel : NativeObject
    {
        private BodyModel(IntPtr pointer) : base(pointer, Native.bch_body_model_free) { }
        /// <summary>The model of a built-in character that comes with the library: 64, 128, 256 or 512 spheres.</summary>
        public static BodyModel Default(Character character, uint spheres = 256)
        {
            IntPtr made;
            Native.Check(Native.bch_body_model_default(character.Pointer, spheres, out made));
            GC.KeepAlive(character);
            return new BodyModel(made);
        }
        /// <summary>Makes a model of a character, in up to a minute; a draft in seconds.</summary>
        public static BodyModel Make(Character character, uint spheres = 256, bool draft = false)
        {
            var options = new BodyOptions { spheres = spheres, draft = draft ? 1 : 0 };
            options.size = (uint)Marshal.SizeOf(options);
            IntPtr made;
            Native.Check(Native.bch_body_model_make(character.Pointer, ref options, IntPtr.Zero, out made));
            GC.KeepAlive(character);
            return new BodyModel(made);
        }
    }

    /// <summary>One body per agent, each in a new pose of its own in every frame. Agent i has shape i.</summary>
    public sealed class LiveBodies : NativeObject
    {
        private readonly int count;

        /// <summary>Body i is one of models[modelOfBody[i]].</summary>
        public LiveBodies(BodyModel[] models, uint[] modelOfBody) : base(Made(models, modelOfBody), Native.bch_live_bodies_free)
        {
            count = modelOfBody.Length;
        }
        private static IntPtr Made(BodyModel[] models, uint[] modelOfBody)
        {
            IntPtr made;
            Native.Check(Native.bch_live_bodies_create(Native.Pointers(models), (UIntPtr)models.Length, modelOfBody, (UIntPtr)modelOfBody.Length, out made));
            GC.KeepAlive(models);
            return made;
        }
        internal IntPtr Set
        {
            get
            {
                IntPtr set;
                Native.Check(Native.bch_live_bodies_get_set(Pointer, out set));
                return set;
            }
        }
        public int Count { get { return count; } }
        /// <summary>Poses all bodies at times of clips, on `threads` threads; 0: one for each processor.</summary>
        public void Pose(uint[] clips, float[] seconds, uint threads = 0)
        {
            Character.Expect("clips", count, clips.Length);
            Character.Expect("seconds", count, seconds.Length);
            var poses = new Pose[count];
            for (int i = 0; i < count; ++i) poses[i] = new Pose { clip = clips[i], seconds = seconds[i] };
            Native.Check(Native.bch_live_bodies_pose(Pointer, poses, threads));
            GC.KeepAlive(this);
        }
        /// <summary>Poses all bodies by transforms, one pose after the other: column-major 4 x 4 matrices, 16 floats each. For bone
        /// matrices, `origins` are x and y of each body's origin.</summary>
        public void Pose(float[] transforms, PoseKind kind = PoseKind.BoneMatrices, double[] origins = null, uint threads = 0)
        {
            if (count == 0 || transforms.Length % (16 * count) != 0)
                throw new ArgumentException("transforms: expected 16 floats for each joint or bone of " + count + " bodies, found " + transforms.Length);
            if (origins != null) Character.Expect("origins", 2 * count, origins.Length);
            using (var pinned = new Pins())
            {
                var poses = new PoseArrays
                {
                    kind = (int)kind, layout = 1, data = pinned.At(transforms), count = (UIntPtr)(transforms.Length / 16 / count), origins = pinned.At(origins)
                };
                poses.size = (uint)Marshal.SizeOf(poses);
                Native.Check(Native.bch_live_bodies_pose_from_arrays(Pointer, ref poses, threads));
            }
            GC.KeepAlive(this);
        }
        /// <summary>The spheres of a body.</summary>
        public Sphere[] Spheres(uint body)
        {
            var spheres = new Sphere[4096];
            UIntPtr found;
            Native.Check(Native.bch_body_set_get_spheres(Set, body, spheres, (UIntPtr)spheres.Length, out found));
            Array.Resize(ref spheres, (int)found);
            GC.KeepAlive(this);
            return spheres;
        }
    }

    /// <summary>A crowd as a game holds it: one value per agent in each array. Arrays are used where they are; fill them in place.</summary>
    public sealed class Agents
    {
        /// <summary>Index of each agent's shape in the set. LiveBodies: the agent's own index.</summary>
        public readonly uint[] Shape;
        public readonly double[] X, Y, Heading;
        /// <summary>Height of the ground under each agent; null: the same for all.</summary>
        public double[] Z;

        public Agents(int count)
        {
            Shape = new uint[count];
            X = new double[count];
            Y = new double[count];
            Heading = new double[count];
            for (uint i = 0; i < count; ++i) Shape[i] = i;
        }
        public int Count { get { return X.Length; } }

        internal AgentView View(Pins pinned)
        {
            if (Z != null) Character.Expect("Z", Count, Z.Length);
            var view = new AgentView
            {
                shape = pinned.At(Shape), x = pinned.At(X), y = pinned.At(Y), heading = pinned.At(Heading), z = pinned.At(Z), count = (UIntPtr)Count
            };
            view.size = (uint)Marshal.SizeOf(view);
            return view;
        }
    }

    /// <summary>Finds who is near whom among all agents, and keeps its memory from call to call.</summary>
    public sealed class Crowd : NativeObject
    {
        /// <summary>The ground repeats after so many metres along x and y; 0: never.</summary>
        public Crowd(double periodX = 0, double periodY = 0) : base(Made(periodX, periodY), Native.bch_crowd_free) { }
        private static IntPtr Made(double periodX, double periodY)
        {
            var options = new CrowdOptions { period_x = periodX, period_y = periodY, max_pairs = ulong.MaxValue };
            options.size = (uint)Marshal.SizeOf(options);
            IntPtr made;
            Native.Check(Native.bch_crowd_create(ref options, out made));
            return made;
        }
        /// <summary>The pairs that collide, each once, with First &lt; Second.</summary>
        public Pair[] Collisions(ShapeSet set, Agents agents)
        {
            Pair[] pairs = null;
            Array.Resize(ref pairs, Collisions(set, agents, ref pairs));
            return pairs;
        }
        public Pair[] Collisions(LiveBodies bodies, Agents agents)
        {
            Pair[] pairs = null;
            Array.Resize(ref pairs, Collisions(bodies, agents, ref pairs));
            return pairs;
        }
        /// <summary>Writes the pairs into an array, which is replaced by a larger one where they need it. Returns how many there are.</summary>
        public int Collisions(ShapeSet set, Agents agents, ref Pair[] pairs)
        {
            return Find(Native.bch_crowd_collisions, set, set.Pointer, agents, ref pairs);
        }
        public int Collisions(LiveBodies bodies, Agents agents, ref Pair[] pairs)
        {
            return Find(Native.bch_crowd_body_collisions, bodies, bodies.Set, agents, ref pairs);
        }
        private int Find(Native.FindPairs find, NativeObject owner, IntPtr set, Agents agents, ref Pair[] pairs)
        {
            using (var pinned = new Pins())
            {
                var view = agents.View(pinned);
                IntPtr found;
                UIntPtr count;
                Native.Check(find(Pointer, set, ref view, IntPtr.Zero, IntPtr.Zero, out found, out count));
                return Copy(found, (int)count, ref pairs, owner);
            }
        }
        /// <summary>The pairs that collide, and how far the first of each has to move, in the best of so many directions.</summary>
        public int Penetrations(ShapeSet set, Agents agents, ref Pair[] pairs, ref Penetration[] depths, uint directions = 16)
        {
            return Measure(Native.bch_crowd_penetrations, set, set.Pointer, agents, ref pairs, ref depths, directions);
        }
        public int Penetrations(LiveBodies bodies, Agents agents, ref Pair[] pairs, ref Penetration[] depths, uint directions = 16)
        {
            return Measure(Native.bch_crowd_body_penetrations, bodies, bodies.Set, agents, ref pairs, ref depths, directions);
        }
        private int Measure(Native.MeasurePairs measure, NativeObject owner, IntPtr set, Agents agents, ref Pair[] pairs, ref Penetration[] depths, uint directions)
        {
            using (var pinned = new Pins())
            {
                var view = agents.View(pinned);
                PenetrationView found;
                Native.Check(measure(Pointer, set, ref view, directions, IntPtr.Zero, IntPtr.Zero, out found));
                Copy(found.depths, (int)found.count, ref depths, owner);
                return Copy(found.pairs, (int)found.count, ref pairs, owner);
            }
        }
        private byte[] kept = new byte[0];
        private int Copy<T>(IntPtr from, int count, ref T[] to, NativeObject owner) where T : struct
        {
            if (to == null || to.Length < count) to = new T[Math.Max(count, to == null ? 0 : 2 * to.Length)];
            int bytes = count * Marshal.SizeOf(typeof(T));
            if (kept.Length < bytes) kept = new byte[2 * bytes];
            using (var pinned = new Pins())
                if (count > 0)
                {
                    Marshal.Copy(from, kept, 0, bytes);
                    Marshal.Copy(kept, 0, pinned.At(to), bytes);
                }
            GC.KeepAlive(this);
            GC.KeepAlive(owner);
            return count;
        }
    }

    /// <summary>Unity's axes: y up, z forwards, left-handed; degrees about y, clockwise seen from above.</summary>
    public static class Unity
    {
        /// <summary>Sets an agent from a transform's position and eulerAngles.y.</summary>
        public static void Place(Agents agents, int i, float x, float y, float z, float degreesAboutY)
        {
            agents.X[i] = z;
            agents.Y[i] = -x;
            agents.Heading[i] = -degreesAboutY * Math.PI / 180;
            if (agents.Z != null) agents.Z[i] = y;
        }
        /// <summary>Converts points, three floats each, in place.</summary>
        public static void Points(float[] points)
        {
            for (int i = 0; i + 2 < points.Length; i += 3)
            {
                float x = points[i], y = points[i + 1];
                points[i] = points[i + 2];
                points[i + 1] = -x;
                points[i + 2] = y;
            }
        }
        private static readonly int[] axis = { 2, 0, 1, 3 }; // of Unity's, for each of ours
        private static readonly float[] sign = { 1, -1, 1, 1 };
        /// <summary>Converts transforms in place, column-major 4 x 4 matrices as Matrix4x4: from maps between Unity's frames to maps between
        /// ours.</summary>
        public static void Transforms(float[] columns)
        {
            var given = new float[16];
            for (int at = 0; at + 15 < columns.Length; at += 16)
            {
                Array.Copy(columns, at, given, 0, 16);
                for (int column = 0; column < 4; ++column)
                    for (int row = 0; row < 4; ++row)
                        columns[at + 4 * column + row] = sign[row] * sign[column] * given[4 * axis[column] + axis[row]];
            }
        }
        /// <summary>Reverses triangles, three indices each, because mirrored axes flip their orientation.</summary>
        public static void Triangles(uint[] triangles)
        {
            for (int i = 0; i + 2 < triangles.Length; i += 3)
            {
                uint second = triangles[i + 1];
                triangles[i + 1] = triangles[i + 2];
                triangles[i + 2] = second;
            }
        }
    }

    // The C interface.

    [StructLayout(LayoutKind.Sequential)]
    internal struct Pose { public uint clip; public float seconds; }
    [StructLayout(LayoutKind.Sequential)]
    internal struct Influence { public uint bone; public float weight; }
    [StructLayout(LayoutKind.Sequential)]
    internal struct CharacterArrays
    {
        public uint size;
        public int root_joint;
        public IntPtr name, vertices;
        public UIntPtr vertex_count;
        public IntPtr triangles;
        public UIntPtr triangle_count;
        public IntPtr parents, rests, joint_names;
        public UIntPtr joint_count;
        public IntPtr bone_joints, inverse_binds;
        public UIntPtr bone_count;
        public IntPtr influence_offsets, influences, clips;
        public UIntPtr clip_count;
        public IntPtr to_ground;
    }
    [StructLayout(LayoutKind.Sequential)]
    internal struct CharacterInfo
    {
        public uint size, joints, clips;
        public float height;
        public ulong vertices, triangles;
        public IntPtr name, notes;
    }
    [StructLayout(LayoutKind.Sequential)]
    internal struct ShapeSetInfo
    {
        public uint size, shapes, levels;
        public int has_heights, outlines, exact_leaves;
        public ulong bytes;
        public IntPtr depths;
    }
    [StructLayout(LayoutKind.Sequential)]
    internal struct BodyOptions { public uint size, spheres; public int draft; }
    [StructLayout(LayoutKind.Sequential)]
    internal struct PoseArrays
    {
        public uint size;
        public int kind, layout;
        public IntPtr data;
        public UIntPtr count, stride;
        public IntPtr origins;
    }
    [StructLayout(LayoutKind.Sequential)]
    internal struct AgentView
    {
        public uint size;
        public IntPtr shape, x, y, heading, level, z;
        public UIntPtr count;
        public int numbers;
        public UIntPtr shape_stride, x_stride, y_stride, heading_stride, level_stride, z_stride;
        public IntPtr heading_y;
        public UIntPtr heading_y_stride;
    }
    [StructLayout(LayoutKind.Sequential)]
    internal struct CrowdOptions { public uint size; public double period_x, period_y; public ulong max_pairs; }
    [StructLayout(LayoutKind.Sequential)]
    internal struct PenetrationView { public UIntPtr count; public IntPtr pairs, depths; }

    /// Arrays that stay where they are for the present call.
    internal sealed class Pins : IDisposable
    {
        private readonly List<GCHandle> handles = new List<GCHandle>();
        public IntPtr At(Array array)
        {
            if (array == null || array.Length == 0) return IntPtr.Zero;
            var handle = GCHandle.Alloc(array, GCHandleType.Pinned);
            handles.Add(handle);
            return handle.AddrOfPinnedObject();
        }
        public void Dispose()
        {
            foreach (var handle in handles) handle.Free();
        }
    }

    internal static class Native
    {
        private const string library = "bch";

        public static void Check(int status)
        {
            if (status != 0) throw new BchException(Marshal.PtrToStringAnsi(bch_last_error()));
        }
        public static IntPtr[] Pointers(NativeObject[] objects)
        {
            return Array.ConvertAll(objects, each => each.Pointer);
        }

        public delegate int FindPairs(IntPtr crowd, IntPtr set, ref AgentView agents, IntPtr filter, IntPtr options, out IntPtr pairs, out UIntPtr count);
        public delegate int MeasurePairs(IntPtr crowd, IntPtr set, ref AgentView agents, uint directions, IntPtr filter, IntPtr options, out PenetrationView found);

        [DllImport(library)] public static extern IntPtr bch_last_error();
        [DllImport(library)] public static extern IntPtr bch_version();
        [DllImport(library)] public static extern int bch_character_default(int which, out IntPtr character);
        [DllImport(library)] public static extern int bch_character_pedestrian(int sex, double stature, double shoulders, out IntPtr character);
        [DllImport(library)] public static extern int bch_character_create(ref CharacterArrays arrays, out IntPtr character);
        [DllImport(library)] public static extern int bch_character_get_info(IntPtr character, ref CharacterInfo info);
        [DllImport(library)] public static extern int bch_character_free(IntPtr character);
        [DllImport(library)] public static extern int bch_bake(IntPtr[] characters, UIntPtr count, uint poses, IntPtr plan, IntPtr work, out IntPtr set);
        [DllImport(library)] public static extern int bch_shape_set_load_bytes(byte[] bytes, UIntPtr size, string name, out IntPtr set);
        [DllImport(library)] public static extern int bch_shape_set_get_info(IntPtr set, ref ShapeSetInfo info);
        [DllImport(library)] public static extern int bch_shape_set_free(IntPtr set);
        [DllImport(library)] public static extern int bch_body_model_default(IntPtr character, uint spheres, out IntPtr model);
        [DllImport(library)] public static extern int bch_body_model_make(IntPtr character, ref BodyOptions options, IntPtr work, out IntPtr model);
        [DllImport(library)] public static extern int bch_body_model_free(IntPtr model);
        [DllImport(library)] public static extern int bch_live_bodies_create(IntPtr[] models, UIntPtr models_count, uint[] model_of_body, UIntPtr count, out IntPtr bodies);
        [DllImport(library)] public static extern int bch_live_bodies_pose(IntPtr bodies, Pose[] poses, uint threads);
        [DllImport(library)] public static extern int bch_live_bodies_pose_from_arrays(IntPtr bodies, ref PoseArrays poses, uint threads);
        [DllImport(library)] public static extern int bch_live_bodies_get_set(IntPtr bodies, out IntPtr set);
        [DllImport(library)] public static extern int bch_live_bodies_free(IntPtr bodies);
        [DllImport(library)] public static extern int bch_body_set_get_spheres(IntPtr set, uint body, [Out] Sphere[] spheres, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)] public static extern int bch_crowd_create(ref CrowdOptions options, out IntPtr crowd);
        [DllImport(library)] public static extern int bch_crowd_collisions(IntPtr crowd, IntPtr set, ref AgentView agents, IntPtr filter, IntPtr options, out IntPtr pairs, out UIntPtr count);
        [DllImport(library)] public static extern int bch_crowd_body_collisions(IntPtr crowd, IntPtr set, ref AgentView agents, IntPtr filter, IntPtr options, out IntPtr pairs, out UIntPtr count);
        [DllImport(library)] public static extern int bch_crowd_penetrations(IntPtr crowd, IntPtr set, ref AgentView agents, uint directions, IntPtr filter, IntPtr options, out PenetrationView found);
        [DllImport(library)] public static extern int bch_crowd_body_penetrations(IntPtr crowd, IntPtr set, ref AgentView agents, uint directions, IntPtr filter, IntPtr options, out PenetrationView found);
        [DllImport(library)] public static extern int bch_crowd_free(IntPtr crowd);
    }

    /// <summary>The native library.</summary>
    public static class Library
    {
        public static string Version { get { return Marshal.PtrToStringAnsi(Native.bch_version()); } }
    }
}
