// The equation that pages show.
#include "report/equation.h"
#include "report/view.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

namespace plumbline::report
{
  namespace
  {
    using Facts = std::map<std::string, std::string>;

    std::string equation_of(Facts facts, const std::vector<double> &horizons = {.4, .2})
    {
      study::StudyResults results;
      results.facts = std::move(facts);
      results.facts["constraint"] = "u = g in the interaction domain";
      for (const double horizon : horizons)
      {
        study::Record record;
        record.key.horizon = horizon;
        results.records.push_back(record);
      }
      return equation(results);
    }

    bool holds(const std::string &text, const std::string &part)
    {
      return text.find(part) != std::string::npos;
    }

    const std::string ball = "∫<sub>|ξ|&lt;δ</sub> ", difference = "[u(x+ξ) − u(x)]";
  } // namespace

  TEST(Equation, OfBondsHasKernelHorizonsAndLimit)
  {
    EXPECT_EQ(equation_of({{"model", "bond-based"},
                           {"dimension", "2"},
                           {"kernel", "linear-decay"},
                           {"local limit", "-1/2 Laplace"}}),
              "L<sub>δ</sub>u(x) = −" + ball + "C(ξ) " + difference +
                  " dξ = b(x) in Ω ⊂ ℝ<sup>d</sup>, d = 2, u = g in the interaction domain; "
                  "kernel linear-decay, C(ξ) = c (1 - r/δ), r = |ξ|; horizon δ = 0.2 to 0.4 "
                  "[length]; local limit -1/2 Laplace.");
    const std::string varying = equation_of({{"model", "bond-based"},
                                             {"dimension", "2"},
                                             {"kernel", "gaussian"},
                                             {"coefficient", "harmonic mean of both ends"}},
                                            {.4});
    EXPECT_TRUE(holds(varying, ball + "a(x, x+ξ) C(ξ) ")) << varying;
    EXPECT_TRUE(holds(varying, "; a: harmonic mean of both ends; "));
    EXPECT_TRUE(holds(varying, "(s is the width of the scene, in horizons)"));
    EXPECT_TRUE(holds(varying, "horizon δ = 0.4 [length]"));
  }

  TEST(Equation, OfSolidsHasADilatationUnlessItIsLeftOut)
  {
    Facts facts = {{"model", "LPS"},
                   {"dimension", "3"},
                   {"kernel", "1/r"},
                   {"constants", "E = 1, nu = 0.3 < 1/2"}};
    const std::string bonds = ball + "2(d+2) μ K(ξ) (ξ⊗ξ/|ξ|²) " + difference + " dξ = b(x)",
                      text = equation_of(facts);
    EXPECT_TRUE(holds(text, "K(ξ) ξ (λ − μ) [θ(x) + θ(x+ξ)] dξ − " + bonds)) << text;
    EXPECT_TRUE(holds(text, "θ(x) = " + ball + "K(ξ) ξ·" + difference + " dξ"));
    EXPECT_TRUE(holds(text, ", d = 3, "));
    EXPECT_TRUE(holds(text, "K(ξ) = c δ/r"));
    EXPECT_TRUE(holds(text, "; E = 1, nu = 0.3 &lt; 1/2."));
    facts["dilatation"] = "none, as lambda = mu";
    EXPECT_TRUE(holds(equation_of(facts), "u(x) = −" + bonds));
    EXPECT_FALSE(holds(equation_of(facts), "θ"));
  }

  TEST(Equation, OfMotionsHasInertia)
  {
    const std::string wells = equation_of({{"model", "double well"},
                                           {"dimension", "1"},
                                           {"kernel", "linear-decay"},
                                           {"final time T", "1"}});
    EXPECT_EQ(wells.find("ρ [ü(x, t) + η u̇(x, t)] − 4/(δ<sup>d+1</sup> ω<sub>d</sub>)"), 0u)
        << wells;
    EXPECT_FALSE(holds(wells, "ω(x)"));
    const std::string weakened = equation_of({{"model", "double well"},
                                              {"dimension", "2"},
                                              {"kernel", "linear-decay"},
                                              {"boundary function", "1 < 2"}});
    EXPECT_TRUE(holds(weakened, ball + "ω(x) ω(x+ξ) J(|ξ|/δ) ")) << weakened;
    EXPECT_TRUE(holds(weakened, ", ω = 1 &lt; 2; kernel linear-decay; "));
    EXPECT_TRUE(holds(wells, "= b(x, t) in Ω ⊂ ℝ<sup>d</sup>, d = 1"));
    EXPECT_TRUE(holds(wells, ", f(s) = c (1 − e<sup>−βs</sup>), "));
    const std::string rational = equation_of({{"model", "double well"},
                                              {"dimension", "2"},
                                              {"kernel", "linear-decay"},
                                              {"potential", "r/(1 + r)"}});
    EXPECT_TRUE(holds(rational, ", f(s) = c g(βs), g(r) = r/(1 + r), ω<sub>d</sub>")) << rational;
  }

  TEST(Equation, IsShownOnThePageOfAKnownModelAlone)
  {
    const fixture::Folder folder;
    study::StudyResults results = fixture::results();
    write_study(statics_view(results), results, folder.path());
    EXPECT_FALSE(holds(fixture::read(folder.path() / "report.html"), "<p class=\"equation\">"));
    EXPECT_EQ(equation_of({{"model", "of somebody else"}, {"dimension", "2"}, {"kernel", "1/r"}}),
              "");
    results.facts = {{"model", "bond-based"}, {"dimension", "2"}, {"kernel", "constant"}};
    write_study(statics_view(results), results, folder.path());
    EXPECT_TRUE(holds(fixture::read(folder.path() / "report.html"),
                      "<p class=\"equation\">" + equation(results) + "</p>"));
  }
} // namespace plumbline::report
