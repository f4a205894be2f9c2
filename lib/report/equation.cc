#include "report/equation.h"

#include "physics/kernel.h"
#include "report/formats.h"

#include <algorithm>
#include <map>

namespace plumbline::report
{
  namespace
  {
    using Facts = std::map<std::string, std::string>;

    const std::string integral = "∫<sub>|ξ|&lt;δ</sub> ", difference = "[u(x+ξ) − u(x)]";

    /// What is added to ρ ü, or is b at rest; what its symbols mean; that of the kernel.
    struct Law
    {
      std::string force, meaning, kernel;
    };

    Law bonds(const Facts &facts)
    {
      const bool varies = facts.count("coefficient") > 0;
      return {"−" + integral + (varies ? "a(x, x+ξ) " : "") + "C(ξ) " + difference + " dξ",
              varies ? "a: " + escape_html(facts.at("coefficient")) : "", "C(ξ)"};
    }

    Law state_based(const Facts &facts)
    {
      const std::string of_bonds = integral + "2(d+2) μ K(ξ) (ξ⊗ξ/|ξ|²) " + difference + " dξ",
                        scale = integral + "K(ξ) |ξ|² dξ = d";
      if (facts.count("dilatation") > 0)
        return {"−" + of_bonds, scale, "K(ξ)"};
      const auto varying = facts.find("varying constants");
      const bool is_one = varying == facts.end();
      return {"−" + integral + "K(ξ) ξ " +
                  (is_one ? "(λ − μ) [θ(x) + θ(x+ξ)]" : "[f(x, x+ξ) θ(x) + f(x+ξ, x) θ(x+ξ)]") +
                  " dξ − " + of_bonds,
              "θ(x) = " + integral + "K(ξ) ξ·" + difference + " dξ, " + scale +
                  (is_one ? "" : ", f = λ − μ, where " + escape_html(varying->second)),
              "K(ξ)"};
    }

    Law double_well(const Facts &facts)
    {
      const bool is_weakened = facts.count("boundary function") > 0;
      const auto potential = facts.find("potential");
      return {"− 4/(δ<sup>d+1</sup> ω<sub>d</sub>) " + integral +
                  (is_weakened ? "ω(x) ω(x+ξ) " : "") + "J(|ξ|/δ) f′(|ξ| S²) S e dξ",
              "e = ξ/|ξ|, S = " + difference + "·e/|ξ|, f(s) = c " +
                  (potential == facts.end() ? std::string("(1 − e<sup>−βs</sup>)")
                                            : "g(βs), g(r) = " + escape_html(potential->second)) +
                  ", ω<sub>d</sub> = volume of the unit ball" +
                  (is_weakened ? ", ω = " + escape_html(facts.at("boundary function")) : ""),
              ""};
    }

    const std::map<std::string, Law (*)(const Facts &)> laws = {{"bond-based", bonds},
                                                                {"LPS", state_based},
                                                                {"variational", state_based},
                                                                {"double well", double_well}};

    std::string kernel_words(const std::string &symbol, const std::string &name)
    {
      std::string text = "kernel " + name;
      const auto &types = physics::kernel_types();
      const auto type = std::find_if(types.begin(), types.end(),
                                     [&](const auto &one) { return one.name == name; });
      if (type == types.end() || symbol.empty())
        return text;
      text += ", " + symbol + " = " + escape_html(type->formula) + ", r = |ξ|";
      return type->key.empty() ? text : text + " (" + escape_html(type->source) + ")";
    }

    std::string horizon_words(const study::Records &records)
    {
      if (records.empty())
        return "";
      const auto [least, most] =
          std::minmax_element(records.begin(), records.end(),
                              [](const study::Record &a, const study::Record &b)
                              { return a.key.horizon < b.key.horizon; });
      const std::string from = rounded(least->key.horizon), to = rounded(most->key.horizon);
      return "horizon δ = " + from + (from == to ? "" : " to " + to) + " [length]";
    }
  } // namespace

  std::string equation(const study::StudyResults &results)
  {
    const Facts &facts = results.facts;
    const auto fact = [&](const std::string &name)
    {
      const auto found = facts.find(name);
      return found == facts.end() ? "" : escape_html(found->second);
    };
    const auto law = laws.find(fact("model"));
    if (law == laws.end())
      return "";
    const auto [force, meaning, kernel] = law->second(facts);
    const bool is_transient = facts.count("final time T") > 0;
    std::string text = is_transient ? "ρ [ü(x, t) + η u̇(x, t)] " + force + " = b(x, t)"
                                    : "L<sub>δ</sub>u(x) = " + force + " = b(x)";
    text += " in Ω ⊂ ℝ<sup>d</sup>, d = " + fact("dimension") + ", " + fact("constraint");
    const std::string limit = fact("local limit");
    for (const std::string &part :
         {meaning, kernel_words(kernel, fact("kernel")), horizon_words(results.records),
          limit.empty() ? "" : "local limit " + limit, fact("constants"), fact("broken bonds")})
      if (!part.empty())
        text += "; " + part;
    return text + ".";
  }
} // namespace plumbline::report
