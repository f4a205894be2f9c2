// What is random in a scene: variables and fields in its expressions, and what is refused.

#include "base/error.h"
#include "scene/problem.h"
#include "tests/text_folder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using dealii::Point;

  using Settings = std::vector<scene::Override>;

  /// @param name  of its file, for other files beside it
  scene::Scene random_scene(const Settings &settings, const std::string &name = "random")
  {
    Settings all = {{"Domain/boxes", "0, 0 : 2, 1"},
                    {"Domain/mesh", "squares"},
                    {"Random/variables", "c: normal 1 0.2; d: uniform 2 4"},
                    {"Problem/solution", "c*x + d*y"},
                    {"Methods/names", "PA-AC"},
                    {"Study/h", "0.25"},
                    {"Sampling/rule", "tensor"},
                    {"Sampling/counts", "2"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return scene::parse_scene(name, "", all);
  }

  void expect_refused(const Settings &settings, const std::string &message)
  {
    try
    {
      (void)random_scene(settings);
      ADD_FAILURE() << "not refused: " << message;
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos)
          << message << " is not in: " << error.what();
    }
  }

  /// A solid whose modulus follows a field.
  Settings solid(const Settings &settings)
  {
    Settings all = {{"Kernel/type", "1/r"},          {"Kernel/limit", "Navier"},
                    {"Material/model", "LPS"},       {"Material/E", "2 + c + R"},
                    {"Material/nu", "0.25"},         {"Problem/solution", "x, y"},
                    {"Sampling/rule", "Monte Carlo"}};
    if (std::none_of(settings.begin(), settings.end(),
                     [](const auto &one) { return one.key == "Random/field"; }))
      all.insert(all.end(), {{"Random/field", "ellipses"}, {"Random/semi-axes", "0.1, 0.06"}});
    all.insert(all.end(), settings.begin(), settings.end());
    return all;
  }

  double modulus(const scene::Scene &scene, const Point<2> &x)
  {
    return 2.5 * scene.material.lame()(x).mu; // E at nu = 1/4
  }

  /// R at the mean of c.
  double field_at(const scene::Scene &scene, const Point<2> &x)
  {
    return modulus(scene, x) - 3;
  }

  /// The same solid with pictures for its field.
  Settings with_files(const std::string &files, const Settings &settings = {})
  {
    Settings all = solid({{"Random/field", "files"}, {"Random/files", files}});
    all.insert(all.end(), settings.begin(), settings.end());
    return all;
  }
} // namespace

TEST(RandomScene, IsTakenAtMeansOrValues)
{
  const scene::Scene means = random_scene({}),
                     given = random_scene({{"Random/values", "0.5, 2.5"}});
  const Point<2> x(.25, .5);
  const auto u = [&](const scene::Scene &scene)
  { return make_problem(scene, 0, scene.study.series[0].levels[0]).solution->value(x, 0); };
  EXPECT_DOUBLE_EQ(u(means), 1 * .25 + 3 * .5);
  EXPECT_DOUBLE_EQ(u(given), .5 * .25 + 2.5 * .5);
  EXPECT_DOUBLE_EQ(u(at_sample(means, {.5, 2.5}, 1)), .5 * .25 + 2.5 * .5);
}

TEST(RandomScene, EllipsesAreZeroAndOneAndOfTheirRealisation)
{
  const scene::Scene scene = random_scene(solid({{"Random/fraction", "0.5"}}));
  const scene::Scene same = at_sample(scene, {}, 1), other = at_sample(scene, {}, 2);
  unsigned int n_in = 0, n_differ = 0;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 20; ++j)
    {
      const Point<2> x(.05 * i, .05 * j);
      const double R = modulus(scene, x) - 3;
      EXPECT_NEAR(R * (1 - R), 0, 1e-13);
      EXPECT_EQ(modulus(same, x), modulus(scene, x));
      n_in += R > .5;
      n_differ += std::abs(modulus(other, x) - modulus(scene, x)) > .5;
    }
  EXPECT_NEAR(n_in / 800., .5, .2);
  EXPECT_GT(n_differ, 200u);
  EXPECT_FALSE(scene.material.is_homogeneous);
  // beyond the box it is as at the nearest point
  EXPECT_EQ(modulus(scene, {-1, .3}), modulus(scene, {0, .3}));
  EXPECT_EQ(modulus(random_scene(solid({{"Random/fraction", "1"}})), {.3, .3}), 4);
  EXPECT_EQ(modulus(random_scene(solid({{"Random/fraction", "0"}})), {.3, .3}), 3);
}

TEST(RandomScene, FieldsOfModesAreLinearInThem)
{
  const Settings field = solid({{"Random/field", "Gaussian"},
                                {"Random/modes", "3"},
                                {"Random/cell", "0.1"},
                                {"Random/length", "0.5"},
                                {"Random/mean", "0.7"},
                                {"Random/deviation", "0.3"}});
  const scene::Scene mean = random_scene(field);
  const Point<2> x(.31, .77);
  EXPECT_NEAR(modulus(mean, x), 3.7, 1e-13);
  const auto R = [&](const std::vector<double> &modes)
  {
    std::vector<double> values = {1, 3};
    values.insert(values.end(), modes.begin(), modes.end());
    return modulus(at_sample(mean, values, 1), x) - 3;
  };
  const double first = R({1, 0, 0}) - .7, third = R({0, 0, 1}) - .7;
  EXPECT_GT(std::abs(first), .01);
  EXPECT_NEAR(R({2, 0, -3}), .7 + 2 * first - 3 * third, 1e-13);
  // three modes hold less than all of the variance
  const uq::Expansion &expansion = *mean.random.source->expansion();
  EXPECT_LT(expansion.variance_kept(), 1);
  EXPECT_GT(expansion.variance_kept(), .5);
  EXPECT_NEAR(expansion.total_variance(), .09 * 2, 1e-12);
}

TEST(RandomScene, FieldsFillTheBoxThatIsGiven)
{
  const auto field = [](const std::string &mesh, const std::string &box)
  {
    return solid({{"Domain/boxes", mesh == "squares" ? "0, 0 : 2, 1" : "0, 0 : 1, 1"},
                  {"Domain/arguments", mesh == "squares" ? "" : "-3 : 3 : false"},
                  {"Domain/inside", mesh == "squares" ? "" : "1 - x^2 - y^2"},
                  {"Random/field", "exponential"},
                  {"Random/modes", "3"},
                  {"Random/cell", "0.25"},
                  {"Random/deviation", "0.3"},
                  {"Random/box", box},
                  {"Domain/mesh", mesh}});
  };
  const scene::Scene ball = random_scene(field("hyper_cube", "-1.5, -1 : 1.5, 1"));
  const uq::Expansion &expansion = *ball.random.source->expansion();
  EXPECT_NEAR(expansion.total_variance(), .09 * 6, 1e-12);
  const scene::Scene at = at_sample(ball, {1, 3, 1, 1, 1}, 1);
  EXPECT_GT(std::abs(modulus(at, {-1.4, -.9}) - modulus(at, {-.5, -.5})), .001);
  EXPECT_EQ(modulus(at, {-1.6, -.9}), modulus(at, {-1.5, -.9}));
  expect_refused(field("hyper_cube", ""), "not known before the mesh is made; give Random/box");
  expect_refused(field("squares", "0, 0 : 1, 1; 1, 1 : 2, 2"), "2 boxes; give one");
}

TEST(RandomScene, PrincipalComponentsOfEllipsesAreNearlyGrey)
{
  const scene::Scene scene = random_scene(solid({{"Random/fraction", "0.4"},
                                                 {"Random/modes", "4"},
                                                 {"Random/cell", "0.05"},
                                                 {"Random/realisations", "200"}}));
  const uq::Expansion &expansion = *scene.random.source->expansion();
  double mean = 0;
  for (const double one : expansion.mean)
    mean += one / static_cast<double>(expansion.mean.size());
  EXPECT_NEAR(mean, .4, .02);
  EXPECT_LT(expansion.variance_kept(), .2);
  const scene::Scene at = at_sample(scene, {1, 3, 1, -1, 1, 1}, 1);
  for (const Point<2> x : {Point<2>(.5, .5), Point<2>(1.2, .3)})
    EXPECT_NEAR(modulus(at, x) - 3, .4, .35); // neither 0 nor 1
}

TEST(RandomScene, FilesFillTheBoxWithTheirFirstLineOnTop)
{
  const tests::TextFolder folder("pictures");
  const std::string file = folder.write("a.csv", "1,2,3\n4,5,6\n");
  const scene::Scene scene = random_scene(with_files(file)); // cells of 2/3 by 1/2
  const auto expect_field = [](const scene::Scene &scene, const Point<2> &x, double value)
  { EXPECT_NEAR(field_at(scene, x), value, 1e-13) << x; };
  for (const double x : {.01, .3, .65}) // constant in a cell
  {
    expect_field(scene, {x, .99}, 1);
    expect_field(scene, {x, .51}, 1);
    expect_field(scene, {x, .49}, 4);
    expect_field(scene, {x, .01}, 4);
  }
  expect_field(scene, {.68, .6}, 2);
  expect_field(scene, {1.3, .4}, 5);
  expect_field(scene, {1.4, .6}, 3);
  expect_field(scene, {1.4, .4}, 6);
  // beyond the box as at the nearest point
  expect_field(scene, {-5, .8}, 1);
  expect_field(scene, {1, 7}, 2);
  expect_field(scene, {3, 2}, 3);
  expect_field(scene, {2.1, -1}, 6);
  EXPECT_FALSE(scene.material.is_homogeneous);
  // over a box that is given, larger than the domain: cells of 4/3 by 3/2
  const scene::Scene boxed = random_scene(with_files(file, {{"Random/box", "-1, -1 : 3, 2"}}));
  expect_field(boxed, {.3, .6}, 1);
  expect_field(boxed, {.4, .6}, 2);
  expect_field(boxed, {.4, .4}, 5);
  expect_field(boxed, {1.7, .4}, 6);
}

TEST(RandomScene, FilesAreTakenInTurnAndNamedFromTheFolderOfTheScene)
{
  const tests::TextFolder folder("pictures");
  std::string files;
  for (const char *const value : {"7", "8", "9"})
  {
    folder.write(std::string(value) + ".csv", value);
    files += std::string(files.empty() ? "" : ", ") + value + ".csv";
  }
  const auto taken = [&](const std::string &key, const std::string &value) {
    return random_scene(with_files(files, {{key, value}}), (folder.path() / "scene.prm").string());
  };
  const scene::Scene scene = taken("Random/realisation", "1");
  const Point<2> x(.5, .5);
  for (unsigned int k = 1; k <= 7; ++k)
    EXPECT_NEAR(field_at(at_sample(scene, {}, k), x), 7 + (k - 1) % 3, 1e-13) << k;
  EXPECT_NEAR(field_at(taken("Random/realisation", "2"), x), 8, 1e-13);
  EXPECT_NEAR(field_at(taken("Random/realisation", "0"), x), 9, 1e-13); // before the first
  // a scene that is built anew for each sample knows them still
  const scene::Scene keyed = taken("Random/keys", "Geometry/seed: 7");
  EXPECT_NEAR(field_at(at_sample(keyed, {1, 3}, 3), x), 9, 1e-13);
}

// Deviations from the mean are 2 p, -p + q and -p - q with p = 1 on the left and -1 on the right, q
// = 1 below and -1 above: their sample covariance is 3 p pᵀ + q qᵀ, and p and q have the norm √2 in
// L2 of the box.
TEST(RandomScene, PrincipalComponentsOfFilesAreThoseByHand)
{
  const tests::TextFolder folder("pictures");
  const std::string files = folder.write("a.csv", "5,2\n3,0\n") + ", " +
                            folder.write("b.csv", "1,4\n1,4\n") + ", " +
                            folder.write("c.csv", "3,6\n-1,2\n");
  const scene::Scene scene = random_scene(with_files(files, {{"Random/modes", "2"}}));
  const uq::Expansion &expansion = *scene.random.source->expansion();
  EXPECT_EQ(expansion.grid.n, (std::array<int, 2>{2, 2}));
  const std::vector<double> mean = {1, 2, 3, 4}, p = {1, -1, 1, -1}, q = {1, 1, -1, -1};
  EXPECT_NEAR(expansion.eigenvalue[0], 6, 1e-12);
  EXPECT_NEAR(expansion.eigenvalue[1], 2, 1e-12);
  for (unsigned int i = 0; i < 4; ++i)
  {
    EXPECT_NEAR(expansion.mean[i], mean[i], 1e-12) << i;
    EXPECT_NEAR(expansion.variance[i], 4, 1e-12) << i;
    EXPECT_NEAR(expansion.mode[0][i], p[i] / std::sqrt(2.), 1e-12) << i;
    EXPECT_NEAR(expansion.mode[1][i], q[i] / std::sqrt(2.), 1e-12) << i;
  }
  const auto R = [&](double first, double second, const Point<2> &x) {
    return field_at(at_sample(scene, {1, 3, first, second}, 1), x);
  };
  for (const Point<2> x : {Point<2>(.01, .01), Point<2>(.5, .25), Point<2>(.99, .49)})
    EXPECT_NEAR(R(.3, -.2, x), 1 + .3 * std::sqrt(3.) - .2, 1e-12); // constant in a cell
  EXPECT_NEAR(R(.3, -.2, {5, 5}), 4 - .3 * std::sqrt(3.) + .2, 1e-12);
  EXPECT_NEAR(field_at(scene, {1.5, .2}), 2, 1e-12); // the mean
  const Settings one = with_files(files, {{"Random/modes", "1"}});
  EXPECT_NEAR(random_scene(one).random.source->expansion()->variance_kept(), .75, 1e-12);
}

TEST(RandomScene, AllPrincipalComponentsGiveEachFileBack)
{
  constexpr int n_x = 24, n_y = 13; // more cells than are seen as a dense matrix
  const tests::TextFolder folder("pictures");
  std::string files;
  for (int k = 0; k < 3; ++k)
  {
    std::string text;
    for (int j = 0; j < n_y; ++j)
      for (int i = 0; i < n_x; ++i)
      {
        text += (i * (k + 2) + j * j) % 7 < 3 ? '1' : '0';
        text += i + 1 < n_x ? ',' : '\n';
      }
    files += (k > 0 ? ", " : "") + folder.write(std::to_string(k) + ".csv", text);
  }
  const scene::Scene whole = random_scene(with_files(files)),
                     modes = random_scene(with_files(files, {{"Random/modes", "2"}}));
  const uq::Expansion &expansion = *modes.random.source->expansion();
  const uq::Grid &grid = expansion.grid;
  ASSERT_EQ(grid.n, (std::array<int, 2>{n_x, n_y}));
  EXPECT_NEAR(expansion.variance_kept(), 1, 1e-12);
  for (unsigned int k = 1; k <= 3; ++k)
  {
    const scene::Scene one = at_sample(whole, {}, k);
    std::vector<double> values;
    for (int j = 0; j < n_y; ++j)
      for (int i = 0; i < n_x; ++i)
        values.push_back(field_at(one, grid.node(i, j)));
    const std::vector<double> xi = expansion.coordinates(values);
    const scene::Scene again = at_sample(modes, {1, 3, xi[0], xi[1]}, 1);
    for (int j = 0; j < n_y; ++j)
      for (int i = 0; i < n_x; ++i)
        EXPECT_NEAR(field_at(again, grid.node(i, j)), field_at(one, grid.node(i, j)), 1e-12);
  }
}

TEST(RandomScene, FilesThatMakeNoFieldAreRefused)
{
  const tests::TextFolder folder("pictures");
  const std::string wide = folder.write("wide.csv", "1,2,3\n4,5,6\n"),
                    high = folder.write("high.csv", "1,2\n3,4\n5,6\n"),
                    point = folder.write("point.csv", "1\n"),
                    ragged = folder.write("ragged.csv", "1,2\n3,4,5\n"),
                    words = folder.write("words.csv", "1,2\n3,four\n"),
                    none = folder.write("none.csv", "\n"),
                    missing = (folder.path() / "missing.csv").string();
  expect_refused(with_files(""), "Random/field = files needs Random/files, which is empty; give");
  expect_refused(with_files(wide + ", " + missing),
                 "Random/files: '" + missing + "' cannot be read; give the name of a file");
  expect_refused(with_files(folder.path().string()), "cannot be read; give the name of a file");
  expect_refused(with_files(ragged), "Random/files: '" + ragged +
                                         "', line 2: has 3 numbers, and the rows above have 2");
  expect_refused(with_files(words), "Random/files: '" + words +
                                        "', line 2: 'four' is not a finite number; write numbers");
  expect_refused(with_files(none), "Random/files: '" + none + "' has no numbers; write a row");
  expect_refused(with_files(wide + ", " + high), "Random/files: '" + high +
                                                     "' has 2 x 3 numbers along x and y, and '" +
                                                     wide + "' has 3 x 2; all must have one size");
  expect_refused(solid({{"Random/files", "a.csv, b.csv"}}),
                 "Random/files = a.csv, b.csv is for Random/field = files, but Random/field = "
                 "ellipses; clear it, or write files");
  expect_refused({{"Random/files", "a.csv"}}, "but Random/field = none; clear it");
  const auto modes = [](const std::string &files, const std::string &n) {
    return with_files(files, {{"Random/modes", n}});
  };
  expect_refused(modes(wide, "1"),
                 "Random/modes = 1, but Random/files (1, of 6 cells each) have 0 principal "
                 "components; write no more, 0 to draw them whole, or give more files");
  expect_refused(modes(wide + ", " + wide + ", " + wide, "3"),
                 "Random/modes = 3, but Random/files (3, of 6 cells each) have 2 principal");
  expect_refused(modes(point + ", " + point + ", " + point, "2"),
                 "Random/modes = 2, but Random/files (3, of 1 cells each) have 1 principal");
  expect_refused(
      with_files(wide, {{"Sampling/rule", "tensor"}}),
      "Random/field = files has complete realisations without variables; give Random/modes");
  expect_refused(
      with_files(wide, {{"Domain/mesh", "hyper_cube"},
                        {"Domain/arguments", "-3 : 3 : false"},
                        {"Domain/inside", "1 - x^2 - y^2"}}),
      "Random/field = files with Domain/mesh = hyper_cube needs a box, which is not known");
}

TEST(RandomScene, IsRefusedWithTheRemedy)
{
  expect_refused({{"Sampling/counts", ""}}, "needs Sampling/counts");
  expect_refused({{"Sampling/counts", "3, 2"}}, "must be strictly increasing");
  expect_refused({{"Sampling/counts", "2, 0.5"}}, "'0.5' is not a count");
  expect_refused({{"Sampling/counts", "0, 2"}}, "gives no sample");
  expect_refused({{"Sampling/rule", "equidistant"}}, "normal variables are unbounded");
  expect_refused({{"Sampling/counts", "1001"}}, "1.002e+06 samples, more than");
  expect_refused({{"Random/variables", ""}}, "unknown name");
  expect_refused({{"Random/variables", ""}, {"Problem/solution", "x"}}, "needs random variables");
  expect_refused({{"Random/variables", "c: normal 0 0"}}, "a deviation must be positive");
  expect_refused({{"Random/variables", "c: uniform 2 1"}}, "must be below");
  expect_refused({{"Random/variables", "c: normal; x: normal"}},
                 "'x' is a reserved or repeated name");
  expect_refused({{"Random/variables", "c: normal; c: normal"}},
                 "'c' is a reserved or repeated name");
  expect_refused({{"Random/variables", "c: gamma"}}, "write 'name: normal");
  expect_refused({{"Random/variables", "c: normal 1"}}, "write 'name: normal");
  expect_refused({{"Random/variables", "c"}}, "has no ':'");
  expect_refused({{"Random/variables", "2c: normal"}}, "is not a name");
  expect_refused({{"Random/values", "1"}}, "1 numbers for 2 variables");
  expect_refused({{"Random/modes", "3"}}, "needs a field");
  expect_refused(
      {{"Sampling/rule", "Smolyak"}, {"Sampling/growth", "nested"}, {"Sampling/counts", "5"}},
      "of normal variables there are levels 0 to 4");
  std::string twenty;
  for (int i = 0; i < 20; ++i)
    twenty += "c" + std::to_string(i) + ": normal; ";
  const auto refuse_counts = [](const std::string &counts, const std::string &variables,
                                const Settings &rule, const std::string &message)
  {
    Settings settings = {
        {"Sampling/counts", counts}, {"Random/variables", variables}, {"Problem/solution", "x"}};
    settings.insert(settings.end(), rule.begin(), rule.end());
    expect_refused(settings, "Sampling/counts = " + counts + " with Sampling/rule = " + message);
  };
  const Settings smolyak = {{"Sampling/rule", "Smolyak"}},
                 nested = {{"Sampling/rule", "Smolyak"}, {"Sampling/growth", "nested"}};
  refuse_counts("20", twenty, smolyak,
                "Smolyak and 20 variables takes 8.904e+17 samples, more than 1e+06; take a lower "
                "level, or Sampling/rule = quasi-Monte Carlo");
  refuse_counts("31", twenty, smolyak, "Smolyak and 20 variables takes 1.281e+23 samples");
  refuse_counts("32", twenty, smolyak, "Smolyak and 20 variables takes 3.234e+23 samples");
  refuse_counts("1000000000", twenty, smolyak,
                "Smolyak and 20 variables takes at least 2e+09 samples, more than 1e+06");
  refuse_counts("32", "c: uniform", nested,
                "Smolyak and 1 variable takes at least 4.295e+09 samples, more than 1e+06");
  refuse_counts("12", "c: uniform", nested,
                "Smolyak takes 4097 points of a variable, more than 1025, the limit of a "
                "one-dimensional rule; take a lower level, or Sampling/rule = quasi-Monte Carlo");
  refuse_counts("100000", "c: normal", {},
                "tensor takes 1e+05 points of a variable, more than 1025");
  expect_refused(solid({{"Random/field", "exponential"}}), "needs Random/modes");
  expect_refused(solid({{"Random/field", "Matern"}, {"Random/modes", "4"}}), "Random/cell > 0");
  const auto matern = [](const std::string &key, const std::string &value)
  {
    return solid({{"Random/field", "Matern"},
                  {"Random/modes", "4"},
                  {"Random/cell", "0.5"},
                  {"Random/" + key, value}});
  };
  expect_refused(matern("modes", "9"), "8 cells, which have no more modes");
  expect_refused(matern("length", "0"), "length");
  expect_refused(matern("smoothness", "-1"), "smoothness");
  expect_refused(matern("length", "1, 2, 3"), "one number, or two");
  expect_refused(solid({{"Random/semi-axes", "1, -1"}}), "semi-ax");
  // realisations are no values of variables
  for (const char *const rule : {"tensor", "Smolyak", "quasi-Monte Carlo"})
    expect_refused(solid({{"Sampling/rule", rule}}), "has complete realisations without variables");
  expect_refused(solid({{"Random/fraction", "1"}, {"Random/modes", "2"}, {"Random/cell", "0.1"}}),
                 "is the same everywhere");
}

TEST(RandomScene, SeveralRulesHaveTheirCounts)
{
  const scene::Scene scene = random_scene(
      {{"Sampling/rule", "smolyak,Monte Carlo"}, {"Sampling/counts", "0, 1; 4, 16, 64"}});
  EXPECT_EQ(scene.sampling.rules,
            (std::vector<uq::SampleRule>{uq::SampleRule::smolyak, uq::SampleRule::monte_carlo}));
  EXPECT_EQ(scene.sampling.rule_words(), "Smolyak, Monte Carlo");
  EXPECT_EQ(scene.sampling.counts_of(0), (std::vector<unsigned int>{0, 1}));
  EXPECT_EQ(scene.sampling.counts_of(1), (std::vector<unsigned int>{4, 16, 64}));
  const scene::Scene of_all = random_scene({{"Sampling/rule", "Smolyak, tensor"}});
  EXPECT_EQ(of_all.sampling.counts_of(0), of_all.sampling.counts_of(1));
  // printed, it is the same
  EXPECT_EQ(scene::parse_scene("printed", scene.text).sampling.rules, scene.sampling.rules);

  const auto rules = [](const std::string &names, const std::string &counts = "2") {
    return Settings{{"Sampling/rule", names}, {"Sampling/counts", counts}};
  };
  expect_refused(rules("Smolyak, tensr"),
                 "'Smolyak, tensr' is not allowed, for 'tensr' in it; write one or more of none, "
                 "tensor, Smolyak, Monte Carlo");
  expect_refused(rules("Smolyak, tensr"), "did you mean tensor?");
  expect_refused(rules("Smolyak,"), "is not allowed");
  expect_refused(rules(""), "is not allowed");
  expect_refused(rules("Smolyak, tensor, Smolyak"), "'Smolyak' occurs twice; give each rule once");
  expect_refused(rules("tensor, none"), "'none' stands for no samples");
  expect_refused(rules("tensor, equidistant"), "'equidistant' spans ranges of variables");
  expect_refused(rules("tensor, Smolyak", "2; 1; 4"), "has 3 lists separated by ';' for Sampling/"
                                                      "rule = tensor, Smolyak; give one list");
  expect_refused(rules("tensor", "2; 1"), "has 2 lists separated by ';'");
  expect_refused(rules("tensor, Smolyak", "2; "), "Smolyak needs Sampling/counts, which is empty");
  expect_refused(rules("Smolyak, Monte Carlo", "0, 1"), "Monte Carlo gives no sample");
  expect_refused(solid({{"Sampling/rule", "Monte Carlo, tensor"}}),
                 "has complete realisations without variables");
}

TEST(ScenesOverAVariable, GoThroughItsValues)
{
  const Settings axis = {{"Random/variables", "c: normal 1 2; d: uniform 1 3"},
                         {"Random/keys", "Time/density: d"},
                         {"Problem/solution", "c*x^2"},
                         {"Sampling/rule", "none"},
                         {"Study/regime", "variable"},
                         {"Study/variable", "d"},
                         {"Study/values", "0.5, 2"},
                         {"Study/h", "0.1, 0.05"},
                         {"Study/m", "2, 3"}};
  const scene::Scene scene = random_scene(axis);
  ASSERT_EQ(scene.study.series.size(), 4u);
  EXPECT_EQ(scene.study.series[2].name, "h = 0.05, m = 2");
  const problem::Level &level = scene.study.series[2].levels[1];
  EXPECT_EQ(std::tuple(level.h, level.horizon, level.value), std::tuple(.05, .1, 2.));
  const scene::Scene here = at_level(scene, level);
  EXPECT_EQ(here.time.density, 2);
  EXPECT_EQ(here.random.present_values(), (std::vector<double>{1, 2})); // c stays at its mean
  EXPECT_EQ(here.study.series.size(), 4u);

  const auto refuse = [&](const Settings &change, const std::string &message)
  {
    Settings all = axis;
    all.insert(all.end(), change.begin(), change.end());
    expect_refused(all, message);
  };
  refuse({{"Study/variable", "e"}}, "Study/variable = 'e' is not one of Random/variables (c, d)");
  refuse({{"Study/values", ""}}, "needs Study/values, which is empty");
  refuse({{"Study/values", "1, 1"}}, "strictly increasing; 1 does not");
  refuse({{"Study/values", "-1, 1"}}, "': Study/values: at d = -1: ");
  refuse({{"Study/regime", "delta"}}, "are for Study/regime = variable; write that, or clear both");
  refuse({{"Sampling/rule", "Monte Carlo"}, {"Sampling/counts", "2"}}, "both vary variables");
  refuse(
      {{"Study/norms", "averages L2"}, {"Study/decisive error", "averages L2 | own finest level"}},
      "Study/regime = variable: nothing is refined there");
  refuse({{"Fracture/toughness", "1"}}, "for fracture use samples");
}
