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
