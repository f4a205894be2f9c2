// Certificates and grades as a user meets them: files, exit codes, messages.
#include "command.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace
{
  using namespace plumbline::app;

  const std::string points = "x,y\n0.1,0.2\n0.5,0.5\n0.31,0.73\n0.9,0.4\n";

  std::string scene_with(const std::string &more = "")
  {
    write("certified.csv", points);
    return write("certified.prm", "subsection Kernel\n set type = constant\nend\n"
                                  "subsection Problem\n set solution = sin(3*x)*cos(2*y)\nend\n"
                                  "subsection Methods\n set names = PA-AC\nend\n"
                                  "subsection Study\n set regime = m\n set horizon = 0.25\n"
                                  " set h = 1/8, 1/16, 1/32\nend\n"
                                  "subsection Reference\n set method = Q2\nend\n"
                                  "subsection Output\n set points = " +
                                      write("certified.csv", points) + "\nend\n" + more);
  }

  /// A certificate, once for all tests of a process.
  const fs::path &certificate_folder()
  {
    static const fs::path folder = []
    {
      fs::path made = temporary("certificate");
      const Outcome outcome =
          run("certify " + scene_with() + " -o " + made.string() + " --reference-level 2");
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      return made;
    }();
    return folder;
  }

  std::string problem()
  {
    return " --problem " + (certificate_folder() / "certificate.json").string();
  }

  /// Values at the certified points: u (1 + factor) + h^p, in another order.
  std::string values(const std::string &name, double factor, double h = 0, double p = 1)
  {
    std::ostringstream text;
    text.precision(17);
    text << "u,y,x\n";
    const nlohmann::json certificate = read_json(certificate_folder() / "certificate.json");
    for (std::size_t i = certificate["points"].size(); i-- > 0;)
    {
      const nlohmann::json &one = certificate["points"][i];
      text << one["value"][0].get<double>() * (1 + factor) + std::pow(h, p) << ','
           << one["x"][1].get<double>() + 1e-11 << ',' << one["x"][0].get<double>() << '\n';
    }
    return write(name, text.str());
  }

  /// Bad input; `grade` writes no files.
  void expect_no_grade(const std::string &arguments, const std::string &message)
  {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    expect_found(outcome.err, message, arguments);
  }
} // namespace

TEST(Certify, writes_the_same_certificate_each_time)
{
  const fs::path &folder = certificate_folder();
  const nlohmann::json certificate = read_json(folder / "certificate.json");
  EXPECT_EQ(certificate["schema"], 1);
  ASSERT_EQ(certificate["points"].size(), 4u);
  EXPECT_EQ(certificate["galerkin"]["h"], (std::vector<double>{1. / 16}));
  EXPECT_EQ(certificate["meshfree"]["method"], "PA-AC");
  EXPECT_LE(certificate["galerkin"]["error"].get<double>(),
            certificate["points"][0]["bound"].get<double>());
  expect_found(read(folder / "certificate.csv"), "x,y,u,bound,other,other_bound,difference,digits");
  expect_found(read(folder / "certificate.md"), certificate["sha256"].get<std::string>());
  const fs::path again = temporary("certificate_again");
  const Outcome outcome =
      run("certify " + scene_with() + " -o " + again.string() + " --reference-level 2");
  EXPECT_EQ(read(again / "certificate.json"), read(folder / "certificate.json"));
  // the answer is the last line
  const std::string answer =
      outcome.out.substr(outcome.out.rfind('\n', outcome.out.size() - 2) + 1);
  EXPECT_EQ(answer.find("4 values certified to at least "), 0u) << answer;
  expect_found(answer, " by Q2, confirmed to ");
  fs::remove_all(again);
}

TEST(Certify, agrees_on_two_ranks)
{
  const fs::path folder = temporary("certificate_of_ranks");
  const Outcome outcome = run_on_two_ranks("certify " + scene_with() + " -o " + folder.string() +
                                           " --reference-level 2 --threads 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("4 values certified"), outcome.out.rfind("4 values certified"));
  const nlohmann::json one = read_json(certificate_folder() / "certificate.json"),
                       two = read_json(folder / "certificate.json");
  for (unsigned int i = 0; i < 4; ++i)
    EXPECT_NEAR(two["points"][i]["value"][0].get<double>(),
                one["points"][i]["value"][0].get<double>(), 1e-11);
  fs::remove_all(folder);
}

TEST(Certify, refuses_with_3_where_the_ways_disagree_and_writes_nothing)
{
  const fs::path folder = temporary("disagreement");
  const auto expect_disagreement = [&](const std::string &rule, const std::string &reason)
  {
    const Outcome outcome = run("certify " + scene_with() + " -o " + folder.string() +
                                " --set Methods/names=" + rule + " --quiet");
    EXPECT_EQ(outcome.exit_code, 3) << rule << outcome.out;
    EXPECT_FALSE(fs::exists(folder / "certificate.json"));
    expect_found(outcome.err, "nothing is certified: " + reason);
    for (const std::string x : {"0.1   0.2", "0.5   0.5", "0.31  0.73", "0.9   0.4"})
      EXPECT_NE(outcome.err.find("\n" + x), std::string::npos) << outcome.err;
  };
  // by its own weights it tends to the local limit, whatever the horizon is
  expect_disagreement("GFD", "Q2 and GFD disagree about ");
}

TEST(Certify, works_in_one_dimension)
{
  const std::string points_of_line = write("line.csv", "x\n0.1\n0.32\n0.77\n"),
                    scene = "certify " + scene_with() +
                            " --set Domain/dimension=1 --set 'Domain/boxes=0 : 1' --set "
                            "'Problem/solution=sin(3*x)' --set Output/points=";
  const fs::path folder = temporary("certificate_of_line");
  const Outcome outcome = run(scene + points_of_line + " -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "\n3 values certified to at least ");
  const nlohmann::json certificate = read_json(folder / "certificate.json");
  EXPECT_EQ(certificate["points"][1]["x"], (std::vector<double>{.32}));
  expect_found(read(folder / "certificate.csv"), "x,u,bound,other,other_bound,difference,digits");
  std::ostringstream text;
  text.precision(17);
  text << "x,u\n";
  for (const auto &one : certificate["points"])
    text << one["x"][0].get<double>() << ',' << std::sin(3 * one["x"][0].get<double>()) << '\n';
  const std::string of_line = " --problem " + (folder / "certificate.json").string();
  const Outcome grade =
      run("grade " + write("on_line.csv", text.str()) + of_line + " --require digits=4");
  EXPECT_EQ(grade.exit_code, 0) << grade.err;
  expect_found(grade.out, "\nat least ");
  expect_no_grade("grade " + write("off_line.csv", "x,u\n0.1,1\n0.3,1\n0.77,1\n") + of_line,
                  "line 3: (0.3) is not a point of the certificate");
  EXPECT_EQ(run("grade --points" + of_line).out, "x\n0.1\n0.32\n0.77\n");
  expect_refused(scene + write("outside.csv", "x\n0.1\n1.2\n"),
                 "line 3: (1.2) lies outside of the domain");
  expect_refused(scene + write("of_plane.csv", "x,y\n0.1,0.2\n"),
                 "y = 0.2, but the scene has one dimension; take out the column y");
  expect_refused(scene + points_of_line + " --set Methods/names=OPT",
                 "not integrable in one dimension");
  fs::remove_all(folder);
}

TEST(Certify, refuses_a_certificate_of_no_digits)
{
  const fs::path folder = temporary("no_digits");
  // two waves on 8 cells
  const Outcome outcome =
      run("certify " + scene_with() + " -o " + folder.string() +
          " --set Reference/method=Q1 --set 'Problem/solution=sin(12*x)*cos(12*y)' "
          "--reference-level 1 --quiet");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_FALSE(fs::exists(folder / "certificate.json"));
  expect_found(outcome.err, "nothing is certified: the bound of Q1 does not confirm a single");
}

TEST(Certify, refuses_scenes_that_are_none)
{
  const std::string scene = scene_with();
  expect_refused("certify " + scene + " --set Output/points=", "Output/points is empty");
  expect_refused("certify " + scene + " --set Reference/method=none", "Reference/method = none");
  expect_refused("certify " + scene + " --set Reference/method=IPA-AC",
                 "is not a Galerkin method of the nonlocal problem");
  expect_refused("certify " + scene + " --set Methods/names=Q1", "no meshfree rule");
  expect_refused("certify " + scene + " --set Study/h=1/8,1/16", "2 mesh sizes");
  expect_refused("certify " + scene + " --reference-level 4", "--reference-level = 4");
  expect_refused("certify " + scene + " --set 'Problem/solution=a: x; b: y'", "2 cases");
  const Outcome twice = run("certify " + scene + " --set Output/points=" +
                            write("twice_there.csv", "x,y\n.5,.5\n.1,.2\n.5,.5\n"));
  EXPECT_EQ(twice.exit_code, 2) << twice.err;
  expect_found(twice.err, "line 4: (0.5, 0.5) is listed twice, first as '");
  EXPECT_EQ(twice.err.find("%"), std::string::npos) << "it had begun to solve: " << twice.err;
  const Outcome zero = run("certify " + scene + " --set 'Problem/solution=0*x'");
  EXPECT_EQ(zero.exit_code, 3) << zero.err;
  expect_found(zero.err, "u is 0 at all points");
}

TEST(Grade, of_exact_values_is_what_the_certificate_has)
{
  const Outcome outcome =
      run("grade " + values("exact.csv", 0) + problem() + " --require digits=2");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "\nat least ");
  const Outcome percent =
      run("grade " + values("percent.csv", .01) + problem() + " --require digits=2");
  EXPECT_EQ(percent.exit_code, 1);
  expect_found(percent.out, "\n1 digits");
  expect_found(percent.err, "required digits = 2: ");
  // the certificate's own table is a file of values, too
  const Outcome own =
      run("grade " + (certificate_folder() / "certificate.csv").string() + problem());
  EXPECT_EQ(own.exit_code, 0) << own.err;
}

TEST(Grade, knows_the_certified_problems_by_name)
{
  const Outcome list = run("list problems");
  EXPECT_EQ(list.exit_code, 0) << list.err;
  expect_found(list.out, "NLB-01: ");
  const Outcome points = run("grade --points --problem nlb_01");
  EXPECT_EQ(points.exit_code, 0) << points.err;
  EXPECT_EQ(points.out.substr(0, 12), "x,y\n0.1,0.1\n");
  std::istringstream lines(points.out);
  std::string text, line;
  std::getline(lines, line);
  text = line + ",u\n";
  while (std::getline(lines, line))
  {
    const std::size_t comma = line.find(',');
    std::ostringstream u;
    u.precision(17);
    u << std::sin(3 * std::stod(line)) * std::cos(2 * std::stod(line.substr(comma + 1)));
    text += line + ',' + u.str() + '\n';
  }
  const Outcome grade =
      run("grade " + write("nlb_01.csv", text) + " --problem nLb-01 --require digits=7");
  EXPECT_EQ(grade.exit_code, 0) << grade.err;
  expect_found(grade.out, "\nat least ");
  expect_found(grade.out, "Meshfree rules of Plumbline at the same points:");
  const Outcome scene = run("grade --scene --problem NLB-01");
  expect_found(scene.out, "= wave: sin(3*x)*cos(2*y)\n");
  const std::string file = values("by_name.csv", 0);
  expect_no_grade("grade " + file + " --problem NLB-00",
                  "problem 'NLB-00' is not in the certified set; choose one of NLB-01, NLB-02");
  expect_no_grade("grade --problem NLB-01", "no file of values is given");
  expect_no_grade("grade " + file + " --points --problem NLB-01", "give one of them, and no file");
}

TEST(Grade, of_a_series_has_order_and_limit)
{
  const auto series = [](double factor, double p)
  {
    std::string files;
    for (const double h : {.025, .1, .05}) // in any order
      files += values("series_" + std::to_string(factor) + std::to_string(p) + std::to_string(h) +
                          ".csv",
                      factor, h, p) +
               " ";
    return "grade " + files + problem() + " --h .025,.1,.05 ";
  };
  const Outcome first = run(series(0, 1) + "--require order=0.99,limit=certified");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  expect_found(first.out, "; order 1; converges to the certified solution: ");
  EXPECT_EQ(run(series(0, 1) + "--require order=1.8 --quiet").exit_code, 1);
  EXPECT_EQ(run(series(0, 2) + "--require order=1.99").exit_code, 0);
  const Outcome biased = run(series(.02, 2) + "--require limit=certified");
  EXPECT_EQ(biased.exit_code, 1);
  expect_found(biased.out, "converges to another limit: ");
}

TEST(Grade, refuses_other_points_and_options)
{
  const std::string file = values("graded.csv", 0), end = problem();
  const std::string text = read(file);
  expect_no_grade(
      "grade " + write("less.csv", text.substr(0, text.rfind('\n', text.size() - 2) + 1)) + end,
      "lacks 1 of the 4 points of the certificate, e.g. (0.1, 0.2)");
  expect_no_grade("grade " + write("more.csv", text + "1,0.2,0.6\n") + end,
                  "line 6: (0.6, 0.2) is not a point of the certificate");
  expect_no_grade("grade " + write("twice.csv", text + "1,0.2,0.1\n") + end, "is in line 5, too");
  expect_no_grade("grade " + write("no_u.csv", "x,y\n0.1,0.2\n") + end, "no column u");
  expect_no_grade("grade " + file + end + " --h .1,.05", "2 mesh sizes for 1 files");
  expect_no_grade("grade " + file + end + " --h 0", "not above 0");
  expect_no_grade("grade " + file + end + " --require digits=2.5", "--require 'digits=2.5'");
  expect_no_grade("grade " + file + end + " --require speed=1", "--require 'speed=1'");
  expect_no_grade("grade " + file + end + " --require order=inf", "'inf' is not a number");
  nlohmann::json changed = read_json(certificate_folder() / "certificate.json");
  changed["scene_text"] = changed["scene_text"].get<std::string>() + " ";
  expect_no_grade("grade " + file + " --problem " + write("changed.json", changed.dump()),
                  "sha256 is not that of its scene_text");
  expect_no_grade("grade " + file + " --problem " + file, "certificate '");
  expect_no_grade("grade " + file + " --problem " + write("old.json", "{\"schema\": 0}"),
                  "schema = 0, but this version reads schema 1");
}
