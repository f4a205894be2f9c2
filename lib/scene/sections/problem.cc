#include "scene/keys.h"
#include "scene/problem_sections.h"
#include "scene/values.h"

namespace plumbline::scene
{
  void ProblemSection::declare(Keys &keys)
  {
    const std::string manufactured = "manufactured", solution = "solution";
    keys.add(
        "solution", "", any_text(),
        [this](const std::string &text) { solutions = to_named_expressions(text); },
        "The exact nonlocal solution: a muParser expression in x, y and delta (the horizon), "
        "and t in transient analyses (Time/final time), components separated by ','; several cases "
        "as 'name: expression; name: expression'. weierstrass(x, gamma, n) is a Weierstrass sum of "
        "n + 1 waves with Hoelder exponent gamma, weierstrass_mean(x, gamma, n, width) its average "
        "over an interval of that width centred at x. Empty: not known.");
    keys.add(
        "load", manufactured, any_text(),
        [this, manufactured](const std::string &text) {
          loads =
              text == manufactured ? std::vector<NamedExpression>() : to_named_expressions(text);
        },
        "The body load b: manufactured (the nonlocal operator applied to the solution), or "
        "expressions written like the solution. Loads with jumps or kinks are integrated over "
        "subdivided cells. Integrals may miss features narrower than a seventh of a cell, and "
        "rules that evaluate at nodes miss features between nodes.");
    keys.add(
        "constraint", solution, any_text(),
        [this, solution](const std::string &text)
        {
          constraint.reset();
          if (text != solution)
            constraint = text;
        },
        "u in the interaction domain: solution, or an expression. It is evaluated at nodes: DGQ0 "
        "and DGP0 use its value at the centre of each cell, as one-point rules do, not its "
        "average.");
    keys.add(
        "local solution", solution, any_text(),
        [this](const std::string &text)
        {
          local_solution = base::from_word<LocalSolution>(text).value_or(LocalSolution::expression);
          local_expression = local_solution == LocalSolution::expression ? text : "";
        },
        "Solution of the local limit: solution (if it does not depend on the horizon), none, "
        "computed (by classical finite elements; needs a mesh), or an expression. In transient "
        "analyses: an expression in x, y and t, or computed, by Fourier series, for double wells "
        "on "
        "a torus without a load.");
  }

  std::vector<std::string> ProblemSection::case_names() const
  {
    std::vector<std::string> names;
    for (const NamedExpression &one : solutions.empty() ? loads : solutions)
      names.push_back(one.name);
    return names.empty() ? std::vector<std::string>{"u"} : names;
  }
} // namespace plumbline::scene
