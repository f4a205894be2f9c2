// What results tell of the equation that was solved.
#include "study/model_facts.h"
#include "scene/scene_file.h"

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  using Facts = std::map<std::string, std::string>;

  Facts facts_of(const std::string &name, const std::vector<scene::Override> &settings = {})
  {
    Facts facts;
    add_model_facts(scene::parse_scene("test.prm", scene::scene_template(name), settings), facts);
    return facts;
  }
} // namespace

TEST(ModelFacts, name_kernel_limit_and_constraint_of_bonds)
{
  EXPECT_EQ(facts_of("scalar"), (Facts{{"model", "bond-based"},
                                       {"dimension", "2"},
                                       {"kernel", "linear-decay"},
                                       {"constraint", "u = g in the interaction domain"},
                                       {"local limit", "-1/2 Laplace"}}));
  const Facts tensor = facts_of("tensor", {{"Material/E", "2"}});
  EXPECT_EQ(tensor.at("kernel"), "bond-tensor");
  EXPECT_EQ(tensor.at("local limit"), "Navier");
  EXPECT_EQ(tensor.at("constants"), "E = 2, plane strain");
}

TEST(ModelFacts, say_whether_solids_have_dilatations)
{
  const Facts other = facts_of("LPS"), quarter = facts_of("LPS", {{"Material/nu", "0.25"}});
  EXPECT_EQ(other.at("constants"), "E = 1, nu = 0.3, plane strain");
  for (const char *const absent : {"dilatation", "varying constants", "local limit"})
    EXPECT_EQ(other.count(absent), 0u) << absent;
  EXPECT_EQ(quarter.at("dilatation"), "none, as lambda = mu");
}

TEST(ModelFacts, name_what_is_fixed_of_a_body_and_the_potential_of_double_wells)
{
  EXPECT_EQ(facts_of("variational").at("constraint"),
            "u = g in the constrained parts; families are truncated at the free boundary");
  const Facts wells = facts_of("double-well");
  EXPECT_EQ(wells.at("constraint"), "on a torus");
  EXPECT_EQ(wells.at("constants"), "c = 1, beta = 1");
}

// Fan et al. 2022, assumption 1: of constants 8 λ > μ, and a jump of λ that is not too large.
TEST(ModelFacts, say_whether_the_solid_is_proven_to_be_well_posed)
{
  const std::string &key = assumption_1_fact;
  EXPECT_EQ(facts_of("LPS").at(key).find("holds"), 0u);
  EXPECT_EQ(facts_of("LPS", {{"Material/nu", "0.05"}}).at(key).find("does not hold"), 0u);
  // λ from 1 to 2, μ = λ: 8·2 against (√2 + 1)²; from 1 to 9: 72 against (3 + 8)²
  const Facts varying = facts_of("LPS", {{"Domain/mesh", "squares"},
                                         {"Material/E", ""},
                                         {"Material/nu", ""},
                                         {"Material/lambda", "x < 0.5 ? 1 : 2"},
                                         {"Material/mu", "x < 0.5 ? 1 : 2"}}),
              large = facts_of("LPS", {{"Domain/mesh", "squares"},
                                       {"Material/E", ""},
                                       {"Material/nu", ""},
                                       {"Material/lambda", "x < 0.5 ? 1 : 9"},
                                       {"Material/mu", "x < 0.5 ? 1 : 9"}});
  EXPECT_NE(varying.at(key).find("8 λ∞ = 16 > (√μ∞ + (λ∞ − λ0)/√μ0)² = 5.82843"),
            std::string::npos);
  EXPECT_NE(large.at(key).find("8 λ∞ = 72 <= (√μ∞ + (λ∞ − λ0)/√μ0)² = 121"), std::string::npos);
  EXPECT_EQ(facts_of("variational").count(key), 0u);
}
