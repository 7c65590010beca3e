// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Geometry>
#include <cstdio>

#include "tests/support/quoted.hpp"

// Small FBX files in text, and where FBX's published chain of transforms takes their vertices:
// world = parent T Roff Rp Rpre R Rpost^-1 Rp^-1 Soff Sp S Sp^-1, and a mesh's geometric transform. Written from the documentation,
// with none of the library's code.

namespace bch {

struct FbxTextNode {
  std::string name, kind = "LimbNode";
  int parent = -1;
  std::map<std::string, Eigen::Vector3d> vectors = {};  ///< such as "Lcl Rotation"
  std::map<std::string, int> numbers = {{"InheritType", 1}, {"RotationActive", 1}};
};

struct FbxTextCurve {
  int node;
  std::string property;
  int axis;
  std::vector<double> seconds, values;
  int flags = 4;  ///< 2: constant, 4: linear, 0x408: cubic with these slopes, per second
  float slope = 0, next_slope = 0;
  int layer = 0;
};

struct FbxTextCluster {
  int node;
  std::vector<int> vertices;
  std::vector<double> weights;
  std::string mode = "";
  Eigen::Affine3d mesh_to_bone = Eigen::Affine3d::Identity(), bone = Eigen::Affine3d::Identity();
};

struct FbxTextMesh {
  int node;
  std::vector<Eigen::Vector3d> points;  ///< the corners of a tetrahedron
  std::vector<FbxTextCluster> clusters = {};
  std::vector<int> corners = {0, 2, -2, 0, 1, -4, 1, 2, -4, 2, 0, -4};  ///< of polygons: -1 - the last one
};

/// A scene, its text and its poses.
class FbxText {
 public:
  std::vector<FbxTextNode> nodes;
  std::vector<FbxTextCurve> curves;
  std::vector<FbxTextMesh> meshes;
  std::string more_objects, more_connections;
  double start = 0, stop = 0;  ///< of the clip
  int up_axis = 1, up_sign = 1;
  double unit = 100;  ///< centimetres

  std::string text() const {
    std::string objects = more_objects, links = more_connections;
    for (std::size_t n = 0; n < nodes.size(); ++n) add_node(static_cast<int>(n), objects, links);
    for (std::size_t m = 0; m < meshes.size(); ++m) add_mesh(static_cast<int>(m), objects, links);
    if (!curves.empty()) add_clip(objects, links);
    return test::quoted(
        "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7400\n}\nGlobalSettings:  {\n"
        "Version: 1000\nProperties70:  {\nP: 'UpAxis', 'int', 'Integer', ''," +
        std::to_string(up_axis) + "\nP: 'UpAxisSign', 'int', 'Integer', ''," + std::to_string(up_sign) +
        "\nP: 'UnitScaleFactor', 'double', 'Number', ''," + digits(unit) +
        "\nP: 'TimeMode', 'enum', '', '',6\n}\n}\nObjects:  {\n" + objects + "}\nConnections:  {\n" + links +
        "}\n");
  }

  /// Returns where the vertices are, at rest or at a time of the clip, in the frame of the file.
  std::vector<Eigen::Vector3d> pose(double seconds, bool rest = false) const {
    std::vector<Eigen::Vector3d> positions;
    for (const FbxTextMesh& mesh : meshes)
      for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        const Eigen::Vector3d point = geometric(mesh.node) * mesh.points[p];
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        double weights = 0;
        for (const FbxTextCluster& cluster : mesh.clusters)
          for (std::size_t v = 0; v < cluster.vertices.size(); ++v) {
            if (cluster.vertices[v] != static_cast<int>(p)) continue;
            sum += cluster.weights[v] *
                   (world(cluster.node, seconds, rest).map() * cluster.mesh_to_bone * point);
            weights += cluster.weights[v];
          }
        positions.push_back(mesh.clusters.empty() ? world(mesh.node, seconds, rest).map() * point
                                                  : Eigen::Vector3d(sum / weights));
      }
    return positions;
  }

  /// Sets a cluster's transforms so that it binds the mesh as both stand at rest.
  void bind(FbxTextMesh& mesh) const {
    for (FbxTextCluster& cluster : mesh.clusters) {
      cluster.bone = world(cluster.node, 0, true).map();
      cluster.mesh_to_bone = cluster.bone.inverse() * world(mesh.node, 0, true).map();
    }
  }

 private:
  /// A node's place: rotation, and what scales and shears before it.
  struct World {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(), scale = Eigen::Matrix3d::Identity();

    Eigen::Affine3d map() const {
      Eigen::Affine3d result(Eigen::Translation3d{place});
      result.linear() = rotation * scale;
      return result;
    }
  };

  static Eigen::Matrix3d turned(const Eigen::Vector3d& degrees, int order) {
    const char* const orders[] = {"XYZ", "XZY", "YZX", "YXZ", "ZXY", "ZYX", "XYZ"};
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    for (const char* axis = orders[order]; *axis != 0; ++axis) {
      const int a = *axis - 'X';
      rotation = Eigen::AngleAxisd(degrees[a] * std::numbers::pi / 180, Eigen::Vector3d::Unit(a)) * rotation;
    }
    return rotation;
  }

  static double at(const FbxTextCurve& curve, double time) {
    const auto& t = curve.seconds;
    if (time < t.front()) return curve.values.front();
    for (std::size_t k = 1; k < t.size(); ++k) {
      if (time >= t[k]) continue;
      const double a = curve.values[k - 1], b = curve.values[k], step = t[k] - t[k - 1],
                   u = (time - t[k - 1]) / step;
      if (curve.flags == 2) return a;
      if (curve.flags == 0x102) return b;
      if (curve.flags == 4) return a + u * (b - a);
      const double ma = step * static_cast<double>(curve.slope),
                   mb = step * static_cast<double>(curve.next_slope);
      return a * (2 * u * u * u - 3 * u * u + 1) + ma * (u * u * u - 2 * u * u + u) +
             b * (3 * u * u - 2 * u * u * u) + mb * (u * u * u - u * u);
    }
    return curve.values.back();
  }

  Eigen::Vector3d vector(int node, const std::string& name, double seconds, bool rest) const {
    const auto& vectors = nodes[static_cast<std::size_t>(node)].vectors;
    const auto found = vectors.find(name);
    Eigen::Vector3d value = Eigen::Vector3d::Constant(name.ends_with("Scaling") ? 1 : 0);
    if (found != vectors.end()) value = found->second;
    for (const FbxTextCurve& curve : curves)
      if (!rest && curve.node == node && curve.property == name)
        value[curve.axis] = at(curve, seconds + start);
    return value;
  }

  World world(int node, double seconds, bool rest) const {
    const FbxTextNode& n = nodes[static_cast<std::size_t>(node)];
    const auto v = [&](const char* name) { return vector(node, name, seconds, rest); };
    const auto number = [&](const char* name) { return n.numbers.contains(name) ? n.numbers.at(name) : 0; };
    const auto shift = [&](const char* name, double sign = 1) {
      return Eigen::Translation3d(sign * v(name));
    };
    const bool active = number("RotationActive") != 0;
    const Eigen::Matrix3d pre = active ? turned(v("PreRotation"), 0) : turned({0, 0, 0}, 0);
    const Eigen::Matrix3d post = active ? turned(v("PostRotation"), 0) : turned({0, 0, 0}, 0);
    const Eigen::Matrix3d own = turned(v("Lcl Rotation"), active ? number("RotationOrder") : 0);
    const Eigen::Affine3d local = shift("Lcl Translation") * shift("RotationOffset") *
                                  shift("RotationPivot") * Eigen::Affine3d(pre) * Eigen::Affine3d(own) *
                                  Eigen::Affine3d(post).inverse() * shift("RotationPivot", -1) *
                                  shift("ScalingOffset") * shift("ScalingPivot") *
                                  Eigen::Scaling(v("Lcl Scaling")) * shift("ScalingPivot", -1);
    World above;
    if (n.parent >= 0) above = world(n.parent, seconds, rest);
    World result;
    result.place = above.map() * Eigen::Vector3d(local.translation());
    const Eigen::Matrix3d turn = pre * own * post.inverse();
    Eigen::Matrix3d inherited = above.scale;
    const Eigen::Matrix3d scale = v("Lcl Scaling").asDiagonal();
    if (number("InheritType") == 1) {
      result.rotation = above.rotation * turn;
      result.scale = turn.inverse() * inherited * turn * scale;
      return result;
    }
    if (number("InheritType") == 2 && n.parent >= 0)
      inherited = inherited * vector(n.parent, "Lcl Scaling", seconds, rest).asDiagonal().inverse();
    result.rotation = above.rotation * turn;
    result.scale = inherited * scale;
    return result;
  }

  Eigen::Affine3d geometric(int node) const {
    const auto v = [&](const char* name) { return vector(node, name, 0, true); };
    return Eigen::Translation3d(v("GeometricTranslation")) *
           Eigen::Affine3d(turned(v("GeometricRotation"), 0)) * Eigen::Scaling(v("GeometricScaling"));
  }

  static std::string digits(double number) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.12g", number);
    return buffer;
  }
  template <class Numbers>
  static std::string array(const std::string& name, const Numbers& numbers) {
    std::string list;
    for (const auto& number : numbers)
      list += (list.empty() ? "" : ",") + digits(static_cast<double>(number));
    return name + ": *" + std::to_string(numbers.size()) + " {\n a: " + list + "\n}\n";
  }
  static std::string matrix(const std::string& name, const Eigen::Affine3d& map) {
    const Eigen::Matrix4d m = map.matrix();
    return array(name, std::vector<double>(m.data(), m.data() + 16));
  }
  static std::string link(long below, long above, const std::string& property = "") {
    const std::string of = property.empty() ? "" : ", '" + property + "'";
    return (of.empty() ? "C: 'OO'," : "C: 'OP',") + std::to_string(below) + "," + std::to_string(above) + of +
           "\n";
  }
  static std::string head(const std::string& kind, long id, const std::string& name,
                          const std::string& of = "") {
    return kind + ": " + std::to_string(id) + ", '" + name + "', '" + of + "' {\n";
  }

  void add_node(int n, std::string& objects, std::string& links) const {
    const FbxTextNode& node = nodes[static_cast<std::size_t>(n)];
    objects += head("Model", 100 + n, "Model::" + node.name, node.kind) + "Version: 232\nProperties70:  {\n";
    for (const auto& [name, number] : node.numbers)
      objects += "P: '" + name + "', 'enum', '', ''," + std::to_string(number) + "\n";
    for (const auto& [name, v] : node.vectors)
      objects += "P: '" + name + "', 'Vector3D', 'Vector', ''," + digits(v.x()) + "," + digits(v.y()) + "," +
                 digits(v.z()) + "\n";
    objects += "}\n}\n";
    links += link(100 + n, node.parent < 0 ? 0 : 100 + node.parent);
  }

  void add_mesh(int m, std::string& objects, std::string& links) const {
    const FbxTextMesh& mesh = meshes[static_cast<std::size_t>(m)];
    std::vector<double> numbers;
    for (const Eigen::Vector3d& point : mesh.points)
      numbers.insert(numbers.end(), {point.x(), point.y(), point.z()});
    objects += head("Geometry", 1000 + m, "Geometry::", "Mesh") + array("Vertices", numbers) +
               array("PolygonVertexIndex", mesh.corners) + "GeometryVersion: 124\n}\n";
    links += link(1000 + m, 100 + mesh.node);
    if (mesh.clusters.empty()) return;
    objects += head("Deformer", 2000 + m, "Deformer::", "Skin") + "Version: 101\n}\n";
    links += link(2000 + m, 1000 + m);
    for (std::size_t c = 0; c < mesh.clusters.size(); ++c) {
      const FbxTextCluster& cluster = mesh.clusters[c];
      const long id = 3000 + 100 * m + static_cast<long>(c);
      objects += head("Deformer", id, "SubDeformer::", "Cluster") + "Version: 100\n" +
                 (cluster.mode.empty() ? "" : "Mode: '" + cluster.mode + "'\n") +
                 array("Indexes", cluster.vertices) + array("Weights", cluster.weights) +
                 matrix("Transform", cluster.mesh_to_bone) + matrix("TransformLink", cluster.bone) + "}\n";
      links += link(id, 2000 + m) + link(100 + cluster.node, id);
    }
  }

  void add_clip(std::string& objects, std::string& links) const {
    const auto ticks = [](double seconds) { return std::round(seconds * 46186158000.0); };
    objects += head("AnimationStack", 5000, "AnimStack::Take 001") +
               "Properties70:  {\nP: 'LocalStart', 'KTime', 'Time', ''," + digits(ticks(start)) +
               "\nP: 'LocalStop', 'KTime', 'Time', ''," + digits(ticks(stop)) + "\n}\n}\n";
    std::map<int, bool> layers;
    std::map<std::string, long> curve_nodes;
    long next = 6000;
    for (const FbxTextCurve& curve : curves) {
      const long layer = 5001 + curve.layer;
      if (layers.try_emplace(curve.layer).second) {
        objects += head("AnimationLayer", layer, "AnimLayer::") + "}\n";
        links += link(layer, 5000);
      }
      const auto [place, added] = curve_nodes.try_emplace(
          std::to_string(curve.layer) + " " + std::to_string(curve.node) + curve.property, next);
      if (added) {
        const Eigen::Vector3d v = vector(curve.node, curve.property, 0, true);
        objects += head("AnimationCurveNode", next, "AnimCurveNode::") + "Properties70:  {\n";
        for (int axis = 0; axis < 3; ++axis)
          objects += std::string("P: 'd|") + "XYZ"[axis] + "', 'Number', '', 'A'," + digits(v[axis]) + "\n";
        objects += "}\n}\n";
        links += link(next, layer) + link(next, 100 + curve.node, curve.property);
        ++next;
      }
      std::vector<double> times;
      for (const double seconds : curve.seconds) times.push_back(ticks(seconds));
      objects += head("AnimationCurve", next, "AnimCurve::") + "Default: 0\nKeyVer: 4008\n" +
                 array("KeyTime", times) + array("KeyValueFloat", curve.values) +
                 array("KeyAttrFlags", std::vector<int>{curve.flags}) +
                 array("KeyAttrDataFloat",
                       std::vector<int>{std::bit_cast<std::int32_t>(curve.slope),
                                        std::bit_cast<std::int32_t>(curve.next_slope), 218434821, 0}) +
                 array("KeyAttrRefCount", std::vector<std::size_t>{times.size()}) + "}\n";
      links += link(next++, place->second, std::string("d|") + "XYZ"[curve.axis]);
    }
  }
};

// ---- A man of three joints, whom tests move

inline const std::vector<Eigen::Vector3d> fbx_corners = {{0, 0, 0}, {0.3, 0, 0}, {0, 0.7, 0}, {0, 0, 0.5}};

/// A skeleton of three joints, a skin on two of them, a rigid mesh on the third, and one that marks the origin.
inline FbxText man() {
  FbxText fbx;
  fbx.nodes = {{"Armature", "Null", -1}, {"Hips", "LimbNode", 0}, {"Spine", "LimbNode", 1},
               {"Hat", "Mesh", 2},       {"Tip", "Mesh", 3},      {"Body", "Mesh", -1},
               {"Mark", "Mesh", -1}};
  fbx.nodes[1].vectors["Lcl Translation"] = {0, 0.9, 0};
  fbx.nodes[2].vectors["Lcl Translation"] = {0.1, 0.4, 0};
  fbx.nodes[3].vectors["Lcl Translation"] = {0, 0.3, 0.2};
  fbx.nodes[4].vectors["Lcl Translation"] = {0.1, 0.1, 0};
  fbx.meshes = {{3, fbx_corners}, {4, fbx_corners}, {6, {{-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 3, 2}}}};
  fbx.meshes.push_back({5,
                        {{0, 0.2, 0}, {0.4, 0.8, 0}, {0, 1.5, 0.1}, {0, 0.8, 0.6}},
                        {{1, {0, 1}, {1, 0.25}}, {2, {1, 2, 3}, {0.75, 1, 1}}}});
  fbx.bind(fbx.meshes.back());
  fbx.stop = 1;
  return fbx;
}

/// Turns the spine by all three angles, and moves and scales it.
inline void move_spine(FbxText& fbx) {
  fbx.curves = {
      {2, "Lcl Rotation", 0, {0, 0.5, 1}, {0, 40, -20}}, {2, "Lcl Rotation", 1, {0, 1}, {10, 70}},
      {2, "Lcl Rotation", 2, {0.25, 1}, {-30, 50}},      {2, "Lcl Translation", 1, {0, 1}, {0.4, 0.6}},
      {2, "Lcl Scaling", 0, {0, 1}, {1, 1.5}},           {1, "Lcl Rotation", 1, {0, 1}, {0, 60}}};
}

}  // namespace bch
