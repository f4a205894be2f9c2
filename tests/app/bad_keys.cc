// Values that keys do not take, and errors that nobody foresaw: said in our own words.

#include "refusals.h"

#include "app/unexpected.h"

namespace
{
  using namespace plumbline::app;

  class BadKeys : public Refusals
  {
  protected:
    BadKeys()
        : Refusals("bad_keys", "subsection Problem\n set solution = x^2\nend\n"
                               "subsection Methods\n set names = FA\nend\n")
    {
    }
  };

  /// Of deal.II.
  const std::vector<std::string> raw_words = {"such that",      "MAX_DOUBLE", "An integer",
                                              "floating point", "Any one of", "boolean"};
} // namespace

TEST_F(BadKeys, are_refused_by_key_value_what_is_allowed_and_the_remedy)
{
  const auto refused = [](const std::string &key, const std::string &value,
                          const std::string &allowed, const std::string &by_default)
  {
    return Trial{set(key, value),
                 {key + " = '" + value + "' is not allowed; write " + allowed +
                  ", or remove the key: its default is '" + by_default + "'"}};
  };
  const std::string whole = "a whole number from 0 to ", real = "a number such as 0.5 or 1e-3",
                    rest = "a number above 0 such as 0.5 or 1e-3";
  expect_refusals(
      {refused("Quadrature/max refinements", "many", whole + "8", "4"),
       refused("Quadrature/max refinements", "9", whole + "8", "4"),
       refused("Quadrature/max refinements", "1.5", whole + "8", "4"),
       refused("Kernel/singularity", "2", whole + "1", "0"),
       refused("Geometry/checks", "99999999999", whole + "100000", "24"),
       refused("Geometry/seed", "-1", whole + "2147483647", "1"),
       refused("Solver/max iterations", "0", "a whole number from 1 to 2147483647", "1000"),
       refused("Kernel/constant", "x", real, "1"), refused("Kernel/bulk modulus", "-1", rest, "1"),
       refused("Expected/error tolerance", "0", rest, "0.0005"),
       refused("Solver/tolerance", "nan", "a number from 1e-15 to 0.001", "1e-12"),
       refused("Methods/perturbation", "0.5", "a number from 0 to 0.49", "0"),
       refused("Study/regime", "x", "one of m, delta, delta-m, horizon, variable", "delta"),
       refused("Kernel/symmetrisation", "mean", "one of arithmetic, harmonic", "arithmetic"),
       refused("Output/fields", "maybe", "true or false", "false")});
}

TEST_F(BadKeys, in_lists_are_named_with_how_a_list_is_written)
{
  const std::string write = "; write numbers above 0 such as 0.05 or 1e-3, separated by ";
  const std::string no = " is not allowed", in = " in it" + write;
  expect_refusals(
      {{set("Study/h", "0.1, fine"), {"Study/h = '0.1, fine'" + no + ", for 'fine'" + in + "','"}},
       {set("Study/h", "0.1; 0.05"), {"Study/h = '0.1; 0.05'" + no + write, "its default is '0.1"}},
       {set("Study/m", "1e999"), {"Study/m = '1e999'" + no + write}},
       {set("Study/m", "3,,4"), {"Study/m = '3,,4'" + no + ", for ''" + in}},
       {set("Study/m", "3, 4,"), {"Study/m = '3, 4,'" + no + write}},
       {set("Expected/errors", "FA: 1 one"),
        {"Expected/errors: 'one' is not a number; write numbers such as 0.05 or 1e-3, separated by "
         "blanks"}},
       {set("Domain/interaction domain", "wide"),
        {"Domain/interaction domain: 'wide' is not a number; write one such as"}},
       {set("Domain/boxes", "0, 0 : a, 1"),
        {no + ", for 'a' in it; write boxes 'x0, y0 : x1, y1'"}},
       {set("Domain/boxes", "0,0,1,1"), {no, "; did you mean '0, 0 : 1, 1'?"}},
       {set("Domain/boxes", "0, 0, 0, 1, 2, 3"), {no, "; did you mean '0, 0, 0 : 1, 2, 3'?"}},
       {set("Fracture/no-fail zones", "0, 0, 0.5, 1"), {no, "; did you mean '0, 0 : 0.5, 1'?"}}});
}

TEST_F(BadKeys, with_decimal_commas_are_refused_with_the_number_that_was_meant)
{
  const auto meant = [](const std::string &key, const std::string &value, const std::string &number)
  {
    return Trial{
        set(key, value),
        {key + " = '" + value + "' is not allowed", "did you mean " + number + "? Decimals"}};
  };
  expect_refusals({meant("Study/m", "3,015", "3.015"), meant("Study/h", "0,1", "0.1"),
                   meant("Study/h", "0.1, 0,05", "0.05"), meant("Study/h", "0,1, 0,05", "0.05"),
                   meant("Study/m", "2, 3,05, 4", "3.05"), meant("Study/horizon", "0,4", "0.4"),
                   meant("Study/h", "1,05e-1", "1.05e-1"), meant("Kernel/constant", "1,5", "1.5"),
                   meant("Kernel/constant", "-2,5e3", "-2.5e3"),
                   meant("Problem/load", "x + 1,05*y", "1.05"),
                   meant("Domain/boxes", "0, 0 : 1,05", "1.05"),
                   meant("Kernel/coefficients", "1, 0,05", "0.05")});
  // where one number is due
  expect_refusals(
      {{set("Domain/interaction domain", "1,5"), {"'1,5' is not a number", "did you mean 1.5?"}},
       {set("Problem/solution", "x^2 + 1,5"), {"has 2 component(s)", "did you mean 1.5?"}},
       {set("Study/h", "1,5"), {"must be strictly decreasing", "did you mean 1.5?"}},
       {set("Expected/errors", "FA: 2,5"), {"'2,5' is not a number", "did you mean 2.5?"}}});
  // lists are lists
  const Outcome outcome = run({{set("Study/m", "2,3") + set("Study/h", "0.25,0.125"), {}}})[0];
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(BadKeys, without_effect_are_refused_with_what_they_need)
{
  const auto unused = [](const std::string &key, const std::string &value, const std::string &needs,
                         const std::string &more = "")
  {
    return Trial{set(key, value) + more,
                 {key + " = " + value + " has no effect here: it needs " + needs}};
  };
  expect_refusals(
      {unused("Study/horizon", "0.05", "Study/regime = m or horizon; with delta the horizon is"),
       unused("Study/m", "4", "Study/regime = delta, delta-m or variable",
              set("Study/regime", "m")),
       unused("Kernel/bulk modulus", "2", "a bond tensor"),
       unused("Kernel/constant", "2", "Kernel/limit = none"),
       unused("Kernel/singularity", "1", "a polynomial"),
       unused("Kernel/symmetrisation", "harmonic", "Kernel/coefficient or Kernel/materials"),
       unused("Material/plane", "stress", "Material/E in a scene of two dimensions"),
       unused("Material/beta", "2", "Material/model = double well"),
       unused("Random/smoothness", "2", "Random/field = Matern"),
       unused("Random/overlap", "no", "Random/field = ellipses"),
       unused("Time/damping", "1", "Time/final time"),
       unused("Sampling/counts", "3", "Sampling/rule"),
       unused("Fracture/ties", "0.01", "Fracture/toughness"),
       unused("Expected/growth ends", "separated", "Fracture/toughness"),
       unused("Domain/boxes", "0, 0 : 2, 1", "Domain/mesh = lattice, squares or triangles",
              set("Domain/mesh", "hyper_ball") + set("Domain/inside", "1"))});
  // steps of 'plumbline stability', which `run` has no use for
  const std::string wells = set("Material/model", "double well") +
                            set("Domain/boundary", "periodic") + set("Kernel/limit", "Navier") +
                            set("Problem/solution", "sin(2*pi*x), 0");
  expect_refusals({{wells + set("Time/schemes", "implicit Euler"),
                    {"Time/final time = 0: Material/model = double well has no static analysis, "
                     "because its force is nonlinear; give a time > 0"}}});
  // defaults may stand, and what is turned off keeps its keys
  for (const std::string &more :
       {set("Study/horizon", "0.4"), set("Study/horizon", "4e-1"), set("Kernel/constant", "1.0"),
        set("Sampling/rule", "none") + set("Sampling/counts", "3")})
    EXPECT_EQ(run({{more + set("Study/h", "0.25,0.125"), {}}})[0].exit_code, 0) << more;
}

TEST(Descriptions, say_what_is_allowed_in_our_words)
{
  using namespace plumbline::app;
  for (const std::string section :
       {"Domain", "Kernel", "Material", "Problem", "Methods", "Study", "Reference", "Quadrature",
        "Geometry", "Solver", "Output", "Expected", "Time", "Crack"})
  {
    const Outcome outcome = run("describe " + section);
    EXPECT_EQ(outcome.exit_code, 0) << section;
    for (const std::string &raw : raw_words)
      EXPECT_EQ(outcome.out.find(raw), std::string::npos) << section << ": " << raw;
  }
  expect_found(run("describe Solver/tolerance").out, "allowed: a number from 1e-15 to 0.001\n");
  expect_found(run("describe Study/h").out,
               "allowed: numbers above 0 such as 0.05 or 1e-3, separated");
  expect_found(run("describe Problem/load").out, "allowed: any text\n");
}

TEST(Unexpected, errors_say_what_can_be_done_and_end_with_their_own_words_on_one_line)
{
  const std::string text = plumbline::app::explain_unexpected(
      "\n--------------\nAn error occurred in line <5> of\n   well-known  file\n-----\n");
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  expect_found(text, "a fault of Plumbline");
  expect_found(text, "try fewer levels (--levels) or methods (--methods), and report the scene");
  const std::string own = "(it says: An error occurred in line <5> of well-known file)";
  EXPECT_EQ(text.find(own), text.size() - own.size()) << text;
  expect_found(plumbline::app::explain_unexpected("--\n"), "(it says: nothing)");
}
