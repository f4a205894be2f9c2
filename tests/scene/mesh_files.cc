// A level's mesh is made once, whoever asks for it.
#include "scene/mesh.h"
#include "tests/text_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace plumbline;
using namespace plumbline::scene;

TEST(MeshFiles, are_read_once_for_all_cases_and_copies_of_a_scene)
{
  const tests::TextFolder folder("mesh_files");
  const std::string file = folder.write("square.geo", R"(
    DefineConstant[ h = 0.5, delta = 0.5 ];
    Mesh.MeshSizeMin = h;
    Mesh.MeshSizeMax = h;
    SetFactory("OpenCASCADE");
    Rectangle(1) = {0, 0, 0, 1, 1};
    Rectangle(2) = {-1, -1, 0, 3, 3};
    BooleanFragments{ Surface{2}; Delete; }{ Surface{1}; Delete; }
    Physical Surface("omega") = {1};
    Physical Surface("collar") = {2};
  )");
  const Scene scene = parse_scene("square.prm", "",
                                  {{"Problem/solution", "x"},
                                   {"Methods/names", "P1"},
                                   {"Domain/mesh", file},
                                   {"Study/h", "0.5, 0.25"},
                                   {"Study/m", "2"}});
  const Level coarse{.5, .5}, fine{.25, .5};
  const std::size_t n_coarse = make_mesh(scene, coarse).cells.size();
  const std::size_t n_fine = make_mesh(scene, fine).cells.size();
  EXPECT_GT(n_fine, 2 * n_coarse);

  std::filesystem::remove(file);
  const Scene copy = scene;
  EXPECT_EQ(make_mesh(scene, coarse).cells.size(), n_coarse);
  EXPECT_EQ(make_mesh(copy, fine).cells.size(), n_fine);
  EXPECT_ANY_THROW(make_mesh(copy, {.25, .25})); // another horizon is another collar
}

TEST(InputFiles, are_in_the_text_of_a_scene_by_what_is_in_them)
{
  const tests::TextFolder folder("input_files");
  folder.write("body.geo", "Include \"size.geo\";\nMerge 'part.msh';\n");
  folder.write("size.geo", "h = 0.1;\n");
  folder.write("part.msh", "$MeshFormat\n");
  folder.write("table.csv", "t,rho\n0,1\n1,0\n");
  folder.write("nodes_0.5.csv", "x,y\n0.5,0.5\n");
  folder.write("nodes_0.25.csv", "x,y\n0.5,0.5\n");
  folder.write("grains.csv", "1,0\n0,1\n");
  folder.write("other.csv", "1,0\n0,1\n");
  const auto text = [&]
  {
    return parse_scene((folder.path() / "scene.prm").string(), "",
                       {{"Problem/solution", "x"},
                        {"Methods/names", "FA"},
                        {"Methods/nodes", "nodes_{h}.csv"},
                        {"Domain/mesh", "body.geo"},
                        {"Kernel/type", "table"},
                        {"Kernel/table file", "table.csv"},
                        {"Random/field", "files"},
                        {"Random/files", "grains.csv"},
                        {"Random/box", "0, 0 : 1, 1"},
                        {"Study/h", "0.5, 0.25"}})
        .text;
  };
  const std::string first = text();
  EXPECT_EQ(parse_scene((folder.path() / "scene.prm").string(), first).text, first);
  const auto changes = [&](const std::string &name, const std::string &with)
  {
    const std::string before = text();
    const auto written = std::filesystem::last_write_time(folder.path() / name);
    folder.write(name, with);
    std::filesystem::last_write_time(folder.path() / name, written);
    return text() != before;
  };
  EXPECT_TRUE(changes("body.geo", "Include \"size.geo\";\nMerge 'part.msh';\n// 2\n"));
  EXPECT_TRUE(changes("size.geo", "h = 0.2;\n"));
  EXPECT_TRUE(changes("part.msh", "$MeshFormat\n2.2 0 8\n"));
  EXPECT_TRUE(changes("table.csv", "t,rho\n0,100\n1,100\n"));
  EXPECT_TRUE(changes("nodes_0.25.csv", "x,y\n0.5,0.25\n"));
  EXPECT_TRUE(changes("grains.csv", "1,1\n0,1\n"));
  EXPECT_FALSE(changes("other.csv", "0,0\n0,0\n"));
  EXPECT_FALSE(changes("size.geo", "h = 0.2;\n")); // written, and the same
}
