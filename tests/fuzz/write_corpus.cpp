// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "layout/baked/image.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/scenes.hpp"

namespace bch::test {
namespace {

namespace fs = std::filesystem;

/// Numbers the inputs of one target.
class Folder {
 public:
  Folder(const fs::path& corpus, const char* target) : path_(corpus / target) {
    fs::create_directories(path_);
  }

  void add(const std::string& bytes) {
    std::ofstream stream(path_ / ("seed" + std::to_string(count_++)), std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  fs::path path_;
  int count_ = 0;
};

void add_images(Folder folder) {
  Random random(1);
  const std::vector<Shape> shapes{contour_shape(star(random, 5, 0.2, 0.4), 0.1f),
                                  contour_shape(star(random, 12, 0.1, 0.4), 0.02f)};
  const ShapeSetPlan plans[] = {{{0}},
                                {{all_depths}, true, false},
                                {{0, 1, all_depths}, true, true},
                                {.depths = {0, all_depths}, .slices = {0.4f, 1}},
                                {.depths = {0}, .slices = {0.4f}}};
  for (const ShapeSetPlan& plan : plans)
    for (const char mode : {'\0', '\1', '\3', '\5', '\7'})
      folder.add(mode + BakedBytes(ShapeSet(shapes, plan), origins_of(shapes.size()), few_clips()).text());
}

/// How many shapes and levels there are, whether agents move, the length of their table, both tables.
std::string tables(const std::string& head, const std::string& agents, const std::string& pairs) {
  const std::string length{static_cast<char>(agents.size() & 0xff), static_cast<char>(agents.size() >> 8)};
  return head + length + agents + pairs;
}

void add_tables(Folder folder) {
  const std::string head("\3\2\0", 3), moving("\3\2\1", 3), nul(1, '\0'),
      columns = "id,shape,x,y,heading\n", pairs = "first,second\nana,b\nb,\"c,d\"\n";
  folder.add(tables(head, columns + "ana,0,0,0,0\nb,1,+1.5,-2e-3,3.14\n\"c,d\",2,1e9,-1e9,1e9\n", pairs));
  folder.add(tables(head, "id,x,y,shape,level,heading\n 7 ,1,2,0,1,0\r\n", "second,first\n7,7\n"));
  folder.add(tables(head, columns + "ana,9,nan,inf,1e400\n", "first\n"));
  folder.add(tables(head, "id,shape,x,y,heading,level\n\"a\"\"b\",0,0,0,0,0\n\n", ""));
  folder.add(tables(moving, "id,shape,x,y,heading,dx,dy\na,0,0,0,0,0.5,-1e9\nb,0,1,1,0,,0\n", ""));
  folder.add(tables(head, columns + "ana,0,0,0,0\n" + nul + "b,1,0.3,0,1\n", pairs));
  folder.add(
      tables(head, "id,shape,x,y,z,heading\nana,0,0,0,3,0\nb,1,0,0,-1e9,1\n\"c,d\",2,0,0,nan,1\n", pairs));
  folder.add(tables(head, columns + "ana,0,1" + nul + "000,0,0\nb,0,0,0,0\n", pairs));
  folder.add(tables(head, columns + "a,0,0,0,0\n", "first,second\na,a\n" + nul + "b,a\n"));
  folder.add(tables(head, columns + "\x1b[2J\r\x7f\xc2\x9b,0,0,0,0\n\xe2\x80\xae\xff\xed\xa0\x80,0,1,1,0\n",
                    "first,second\n\x1b[2J\r\x7f\xc2\x9b,\xe2\x80\xae\xff\xed\xa0\x80\n"));
  folder.add(tables(head, "\xff\xfei" + nul + "d" + nul,
                    "\xef\xbb\xbf"
                    "first,second\n"));
}

void add_lines(Folder folder) {
  const char* const lines[] = {
      "bake man.glb woman.glb --poses 200 --threshold 0.02 --depths 0,3,all --semantics solid",
      "bake a --clips b --clips c --up z --scale 1e-2 --threads 4 --isa sse2",
      "bake --depths 3,2 a --isa none --poses -1 --threshold nan",
      "bake --help",
      "-- bake --up=w a",
      "crowd --slices 0.4,1.0 --heights",
      "inspect a --slices 1,,0.4"};
  for (std::string line : lines) {
    for (char& c : line)
      if (c == ' ') c = '\0';
    folder.add(line);
  }
}

void add_gltf(Folder folder) {
  folder.add(SkinnedStrip().file().binary());
  SkinnedStrip strip;
  strip.interpolation = "\"interpolation\":\"STEP\",";
  strip.armature = "\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],";
  strip.mode = 5;
  folder.add(strip.text());
  strip.interpolation = "\"interpolation\":\"CUBICSPLINE\",";
  strip.times = {0};
  folder.add(strip.text());
}

/// Texts of each format; the byte before them chooses options.
void add_recordings(Folder folder) {
  folder.add(
      "\2# framerate: 25 fps\n# id frame x/m y/m z/m\n1 1 1.5 -2 1.76\n1 0 1e1 +2 0.3\n2\t0\t1\t2\t1.5\n");
  folder.add(
      "\3"
      "1 43 79.035 774.009 183.02\n2 43 79 764 183\n1 44 79 764 183\n");
  folder.add(
      "\1"
      "780.0\t1.0\t8.46\t3.59\n790.0\t1.0\t9.57\t3.79\n790.0\t2.0\t1\t2\n");
  folder.add(
      "\5"
      "1 0.04 1 2 3 1.7\n2 0.08 1 2 nan 0\n");
  folder.add(std::string(1, '\0') +
             "\"t\",\"id\",\"name\",\"x\",\"y\",\"z\"\n\"s\",\"\",\"\",\"m\",\"m\",\"m\"\n"
             "0.5,1,\"a, \"\"b\"\"\",1,2,0.02\n0.0,1,\"\",1,2,0.02\n");
  folder.add("\1ID,Frame,x [cm],y [cm],heading,height\n1,2,3,4,0.5,1.8\n2,2,3,4,,\n");
  folder.add(std::string(1, '\0') +
             "{\"scene\": {\"id\": 0, \"fps\": 2.5, \"tag\": [4, [2]]}}\n"
             "{\"track\": {\"f\": 20, \"p\": 1, \"x\": 8.46, \"y\": -3.5, \"prediction_number\": 0}}\n"
             "{\"track\": {\"f\": 10, \"p\": 1, \"x\": 1, \"y\": 2, \"prediction_number\": 1}}\n"
             "{\"track\": {\"f\": 10, \"p\": 1, \"x\": 1, \"y\": 2}}\n");
  folder.add(std::string(1, '\0') + "id,time/ms,x,y\n1,0,1,2\n1,33,1,2\n1,67,1,2\n");
}

void add_noise(Folder folder, std::uint64_t seed) {
  Random random(seed);
  for (const std::uint32_t size : {40u, 150u, 300u, 600u, 1200u}) {
    std::string bytes;
    while (bytes.size() < size) bytes += static_cast<char>(random.below(256));
    folder.add(bytes);
  }
}

}  // namespace
}  // namespace bch::test

int main(int argc, char** argv) {
  using namespace bch::test;
  if (argc != 2) return std::puts("usage: write_corpus FOLDER"), 2;
  add_images({argv[1], "baked_file"});
  add_tables({argv[1], "csv"});
  add_lines({argv[1], "options"});
  add_gltf({argv[1], "gltf"});
  add_recordings({argv[1], "trajectory_text"});
  std::uint64_t seed = 10;
  for (const char* target : {"scene", "outline", "hierarchy", "collide", "c_api"})
    add_noise({argv[1], target}, ++seed);
}
