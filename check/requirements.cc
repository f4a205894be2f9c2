#include "check/requirements.h"

#include "base/error.h"
#include "base/number_text.h"
#include "check/body.h"
#include "meshfree/check/images.h"
#include "meshfree/check/sizes.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

namespace plumbline::check
{
  using namespace meshfree;

  const char *const where_lengths_are_given = " (Study/h, and Study/m or Study/horizon)";

  const char *const requirements_help =
      "Properties that the weights must have; otherwise the exit code is 1. A list; may be "
      "repeated. ac: moments of degree 1 and 2 are exact at every node, to 1e-5 or to the digits "
      "of the files; the limit is then correct for every path of h and horizon to 0. consistent: "
      "at most nodes moments are wrong by at most h/horizon; the limit is then correct only for "
      "h/horizon -> 0. moments=TOL: moments are wrong by at most TOL at every node. symmetric: "
      "w C is equal from both ends, to 1e-5 of the largest, and no bond is without its partner. "
      "m-matrix: a maximum principle holds. Default: ac. In every case, outliers among bonds and "
      "nodes, an error common to all weights, and a matrix that is not positive definite give "
      "exit code 1.";

  namespace
  {
    constexpr std::size_t most_named = 5;

    const std::string cause_word = "cause: ", question = "do h and horizon belong to these bonds? ";

    template <int dim>
    std::string point(const dealii::Point<dim> &x)
    {
      std::string text;
      for (unsigned int d = 0; d < dim; ++d)
        text += (d == 0 ? "(" : ", ") + base::to_text(x[d], 5);
      return text + ")";
    }

    template <int dim>
    std::string off(const Findings<dim> &found)
    {
      const Worst &first = found.moments.defects[0].worst, &second = found.moments.second;
      const std::string of_second = "second moments are off by " + base::to_percent(second.value) +
                                    " at node " + found.id(second.node);
      if (first.value <= MomentCheck::tolerance)
        return of_second;
      return of_second + ", first moments by " + base::to_percent(first.value) + " at node " +
             found.id(first.node);
    }

    template <int dim>
    double worst_of_both(const Findings<dim> &found)
    {
      return std::max(found.moments.second.value, found.moments.defects[0].worst.value);
    }

    template <int dim>
    std::string line_of(const Outlier<dim> &o, const Findings<dim> &found)
    {
      return o.bond == Outlier<dim>::none
                 ? ""
                 : " (line " + std::to_string(found.given.lines[o.node][o.bond]) + " of the bonds)";
    }

    /// The line of the bond back, from its neighbour.
    template <int dim>
    std::string line_back(const Outlier<dim> &o, const Findings<dim> &found)
    {
      const auto &others = found.given.families[o.neighbour].neighbours;
      const auto back = std::lower_bound(others.begin(), others.end(), o.node);
      const auto at = static_cast<std::size_t>(back - others.begin());
      return " (line " + std::to_string(found.given.lines[o.neighbour][at]) + ")";
    }

    template <int dim>
    std::string weight_text(const Outlier<dim> &o)
    {
      const double ratio = o.expected == 0 ? 0 : o.found / o.expected;
      std::string result = "has the weight " + base::to_text(o.found, 5) + " where " +
                           base::to_text(o.expected, 5) + " is expected";
      if (std::abs(ratio + 1) < .01)
        result += ": its sign is flipped";
      else if (ratio < 0)
        result += ": negative, " + base::to_text(ratio, 3) + " times";
      else if (ratio > 0)
        result += ": " + base::to_text(ratio, 3) + " times";
      return result;
    }

    template <int dim>
    bool is_too_inexact(const Findings<dim> &found, const Requirements &required)
    {
      return (required.ac && worst_of_both(found) > found.precision.moments) ||
             (required.moments && worst_of_both(found) > *required.moments);
    }

    /// What the moments make of the solution.
    template <int dim>
    std::string consequence(const Findings<dim> &found)
    {
      const MomentCheck &moments = found.moments;
      const double limit = std::abs(moments.mean_ratio - 1), first = moments.defects[0].median;
      constexpr double much_less = .05;
      if (moments.typical() <= found.precision.moments)
        return "at most nodes they are right";
      if (moments.mean_ratio == 0)
        return "there is no operator";
      if (first > found.precision.moments && limit < much_less * first)
        return "first moments are wrong at most nodes; they act as a drift that grows like 1 / "
               "horizon, so the operator has no limit as horizon and h tend to 0 together";
      return moments.mean_ratio > 0
                 ? "as horizon and h go to 0 together the solution tends to a wrong limit, off by "
                   "about " +
                       base::to_percent(std::abs(1 / moments.mean_ratio - 1)) +
                       ", because the solution scales with the inverse of the operator"
                 : "as horizon and h go to 0 together there is no limit, the operator has the "
                   "wrong sign";
    }
  } // namespace

  namespace
  {
    /// Those without a number, by their words.
    const std::map<std::string, bool Requirements::*> switches = {
        {"ac", &Requirements::ac},
        {"consistent", &Requirements::consistent},
        {"symmetric", &Requirements::symmetric},
        {"m-matrix", &Requirements::m_matrix}};
  } // namespace

  Requirements parse_requirements(const std::vector<std::string> &words)
  {
    Requirements required;
    for (const std::string &list : words)
    {
      std::istringstream in(list);
      for (std::string word; std::getline(in, word, ',');)
        if (const auto found = switches.find(word); found != switches.end())
          required.*found->second = true;
        else if (word.compare(0, 8, "moments=") == 0)
        {
          std::istringstream value(word.substr(8));
          double tolerance = 0;
          if (!(value >> tolerance) || !value.eof() || !(tolerance > 0))
            throw InputError("--require " + word + ": '" + word.substr(8) +
                             "' is no positive number; write moments=0.05");
          required.moments = tolerance;
        }
        else
          throw InputError("--require '" + word +
                           "' is not known; choose one of ac, consistent, moments=TOL, symmetric, "
                           "m-matrix");
    }
    if (words.empty())
      required.ac = true;
    return required;
  }

  template <int dim>
  std::string text(const Outlier<dim> &o, const Findings<dim> &found)
  {
    const std::string node = "node " + found.id(o.node);
    const std::string bond =
        o.neighbour == Outlier<dim>::none
            ? ""
            : "the bond from node " + found.id(o.node) + " to node " + found.id(o.neighbour);
    switch (o.defect)
    {
    case Defect::weight:
      return bond + line_of(o, found) + " " + weight_text(o);
    case Defect::missing:
      return o.is_both_ways
                 ? "the bonds between node " + found.id(o.node) + " and node " +
                       found.id(o.neighbour) + " are missing from both ends; weights of about " +
                       base::to_text(o.expected, 5) + " are expected"
                 : bond + " is missing; a weight of " + base::to_text(o.expected, 5) +
                       " is expected";
    case Defect::spurious:
      return bond + line_of(o, found) + " has the weight " + base::to_text(o.found, 5) +
             " where others like it have none";
    case Defect::kernel_point:
      return bond + line_of(o, found) + " takes the kernel at " + point(o.found_point) + " where " +
             point(o.expected_point) + " is expected";
    case Defect::symmetry:
      return bond + line_of(o, found) + " has w C / volume = " + base::to_text(o.found, 5) +
             ", the bond back" + line_back(o, found) + " " + base::to_text(o.expected, 5) +
             ": more apart than others";
    case Defect::family:
      return "the weights of all bonds from " + node + " are " + base::to_text(o.found, 3) +
             " times what is expected";
    case Defect::neighbour:
      return "the weights of all bonds to " + node + " are " + base::to_text(o.found, 3) +
             " times what is expected, as if its volume were";
    case Defect::volume:
      return "the volume of " + node + " (line " +
             std::to_string(found.nodes.line[found.cells->source[o.node]]) + " of the nodes) is " +
             base::to_text(o.found, 5) + " where " + base::to_text(o.expected, 5) +
             " is expected: " + base::to_text(o.found / o.expected, 3) + " times";
    case Defect::moments:
      break;
    }
    return "the weights of " + node +
           " are inconsistent with those of the other nodes: moments of degree " +
           std::to_string(o.degree) + " are " + base::to_text(o.found, 5) +
           ", the usual value is " + base::to_text(o.expected, 5) +
           ", and no single bond explains the difference";
  }

  namespace
  {
    /// Nodes whose volume is off by one factor.
    template <int dim>
    struct Band
    {
      double ratio;
      std::vector<const Outlier<dim> *> nodes;
    };

    template <int dim>
    std::vector<Band<dim>> volume_bands(const Findings<dim> &found)
    {
      constexpr double same = 1e-3;
      std::vector<Band<dim>> bands;
      for (const Outlier<dim> &one : found.outliers)
        if (one.defect == Defect::volume)
        {
          const double ratio = one.found / one.expected;
          const auto band = std::find_if(bands.begin(), bands.end(),
                                         [&](const Band<dim> &other)
                                         { return std::abs(ratio / other.ratio - 1) < same; });
          if (band == bands.end())
            bands.push_back({ratio, {&one}});
          else
            band->nodes.push_back(&one);
        }
      return bands;
    }

    template <int dim>
    std::string text_of_band(const Band<dim> &band, const Findings<dim> &found)
    {
      std::vector<std::size_t> nodes;
      for (const Outlier<dim> *one : band.nodes)
        nodes.push_back(one->node);
      std::sort(nodes.begin(), nodes.end()); // those of the collar come last
      const std::size_t n_free = static_cast<std::size_t>(
          std::lower_bound(nodes.begin(), nodes.end(), found.cells->n_free) - nodes.begin());
      const auto list = [&](std::size_t from, std::size_t to)
      {
        std::string ids;
        for (std::size_t k = from; k < std::min(from + most_named, to); ++k)
          ids += (k == from ? "" : ", ") + found.id(nodes[k]);
        return std::to_string(to - from) + " nodes (" + ids +
               (to - from > most_named ? " ..." : "") + ")";
      };
      const std::size_t n = nodes.size();
      return "the volumes of " + (n_free > 0 ? list(0, n_free) : "") +
             (n_free > 0 && n > n_free ? " and of " : "") +
             (n > n_free ? list(n_free, n) + " in the collar" : "") + " are " +
             base::to_text(band.ratio, 3) + " times the " + meshfree::measure<dim>() +
             "s of their cells" +
             (found.volume_factor == 1
                  ? ""
                  : ", besides the factor " + base::to_text(found.volume_factor, 4) + " of all");
    }

    template <int dim>
    void add_outliers(const Findings<dim> &found, std::vector<std::string> &complaints)
    {
      std::size_t n_named = 0, n_lines = 0;
      const auto add = [&](const std::string &text, std::size_t n)
      {
        if (n_lines++ >= most_named)
          return;
        complaints.push_back("outlier: " + text);
        n_named += n;
      };
      for (const Band<dim> &band : volume_bands(found))
        add(band.nodes.size() == 1 ? text(*band.nodes.front(), found) : text_of_band(band, found),
            band.nodes.size());
      for (const Outlier<dim> &one : found.outliers)
        if (one.defect != Defect::volume)
          add(text(one, found), 1);
      if (n_named < found.outliers.size())
        complaints.push_back("outliers: " + std::to_string(found.outliers.size() - n_named) +
                             " more (outliers.csv in the output folder lists all)");
    }
  } // namespace

  namespace
  {
    /// Sentences on the families of whole balls, after those on the rest of a body.
    std::vector<std::string> after_body(std::vector<std::string> of_body,
                                        const std::vector<std::string> &of_interior)
    {
      for (const std::string &one : of_interior)
        of_body.push_back("interior: " + one);
      return of_body;
    }

    template <int dim>
    double longest_bond(const Findings<dim> &found)
    {
      double longest = 0;
      for (const Family<dim> &family : found.given.families)
        for (const Bond<dim> &bond : family.bonds)
          longest = std::max(longest, bond.xi.norm());
      return longest;
    }

    /// Whether bonds have the lengths of a lattice of squares.
    template <int dim>
    bool is_on_lattice(const Findings<dim> &found)
    {
      constexpr double tolerance = 1e-6;
      const auto is_whole = [](double x) { return std::abs(x - std::round(x)) < tolerance; };
      for (const Family<dim> &family : found.given.families)
        for (const Bond<dim> &bond : family.bonds)
          for (unsigned int d = 0; d < dim; ++d)
            if (!is_whole(bond.xi[d] / found.level.node_size))
              return false;
      return true;
    }

    /// The largest distance of lattice nodes in the ball, without its boundary [spacings].
    template <int dim>
    double largest_shell(double radius)
    {
      constexpr double boundary = 1e-6;
      double largest = 0;
      for (int i = 0; i < radius; ++i)
        for (int j = 0; j <= i; ++j)
          for (int k = 0; k <= (dim == 3 ? j : 0); ++k)
            if (const double r = std::hypot(i, j, k); r < radius * (1 - boundary))
              largest = std::max(largest, r);
      return largest;
    }

    /// The horizon is not that of the bonds: it differs by more than a spacing, or there are nodes
    /// of a lattice between the longest bond and it, or bonds of a lattice reach cells outside of
    /// the ball.
    template <int dim>
    bool is_other_horizon(const Findings<dim> &found)
    {
      constexpr double shell = 1.05, diagonal = dim == 2 ? .75 : .9, tolerance = 1e-6; // spacings
      const double horizon = found.level.level.horizon, spacing = found.level.node_size,
                   longest = longest_bond(found);
      return longest > 0 &&
             (std::abs(longest - horizon) > shell * spacing ||
              ((longest < (largest_shell<dim>(horizon / spacing) - tolerance) * spacing ||
                longest > horizon + diagonal * spacing) &&
               is_on_lattice(found)));
    }

    /// Moments are those of the scene's horizon: if that is not the horizon of the bonds, all
    /// weights seem wrong, and any cause that is named would be a wrong one.
    template <int dim>
    std::string scene_mismatch(const Findings<dim> &found)
    {
      const double h = found.level.level.h, horizon = found.level.level.horizon,
                   spacing = found.level.node_size, longest = longest_bond(found);
      std::string what;
      if (!found.level.is_near())
        what = "the nodes' spacing is " + base::to_text(spacing, 6) + ", but h is " +
               base::to_text(h, 6) + " and the horizon " + base::to_text(horizon, 6);
      else if (is_other_horizon(found))
        what = "the longest bond is " + base::to_text(longest, 6) + ", but the horizon is " +
               base::to_text(horizon, 6) + " for a spacing of " + base::to_text(spacing, 6);
      return what.empty() ? ""
                          : question + what + "; give the h and the horizon of your bonds" +
                                where_lengths_are_given +
                                " and check again; until then all moments are compared with those "
                                "of a different ball, and no cause is named";
    }

    /// @param is_whole  no bond is known to be missing
    template <int dim>
    void add_matrix(const Findings<dim> &found, const Requirements &required, bool is_whole,
                    std::vector<std::string> &result)
    {
      if (!Findings<dim>::has_matrix)
      {
        if (required.m_matrix && !found.elastic.empty())
          result.push_back("required m-matrix: matrices of bond tensors have positive off-diagonal "
                           "entries; remove this requirement");
        else if (required.m_matrix && found.weights.n_negative > 0)
          result.push_back("required m-matrix: " + std::to_string(found.weights.n_negative) +
                           " weights are negative");
        return;
      }
      if (required.m_matrix && !found.matrix.is_m_matrix())
        result.push_back("required m-matrix: " + std::to_string(found.matrix.n_positive) +
                         " rows with positive off-diagonal entries, " +
                         std::to_string(found.matrix.n_weak) + " not diagonally dominant, " +
                         std::to_string(found.matrix.n_loose) + " not tied to the data");
      if (!found.matrix_failure.empty())
        result.push_back("the matrix cannot be examined: " + found.matrix_failure);
      else if (is_whole && !found.matrix.is_positive_definite())
        result.push_back("the matrix is NOT positive definite: " +
                         std::to_string(found.matrix.n_negative_eigenvalues) +
                         " negative eigenvalues");
    }

    template <int dim>
    std::vector<std::string> interior_complaints(const Findings<dim> &found,
                                                 const Requirements &required)
    {
      std::vector<std::string> result;
      const double ratio = found.level.node_size / found.level.level.horizon;
      const std::string no_crossing = missing_crossings(found.n_crossing);
      if (!no_crossing.empty())
        result.push_back(cause_word + no_crossing); // outliers and the matrix follow from it
      else
      {
        for (const Cause &cause : found.causes)
          if (!cause.is_own_error || is_too_inexact(found, required))
            result.push_back(cause_word + cause.text);
        add_outliers(found, result);
      }
      if (required.ac && worst_of_both(found) > found.precision.moments)
        result.push_back("required ac: " + off(found));
      if (required.consistent && found.moments.typical() > ratio)
        result.push_back("required consistent: moments of most nodes are off by " +
                         base::to_percent(found.moments.typical()) + ", more than h/horizon = " +
                         base::to_percent(ratio) + ", so that it is no matter of h/horizon");
      if (required.moments && worst_of_both(found) > *required.moments)
        result.push_back("required moments=" + base::to_text(*required.moments, 5) + ": " +
                         off(found));
      if (required.symmetric && !found.body &&
          (found.symmetry.asymmetry > found.precision.moments || found.symmetry.n_unpaired > 0))
        result.push_back("required symmetric: w C of a pair differs from end to end by up to " +
                         base::to_percent(found.symmetry.asymmetry) +
                         " of the largest, between nodes " + found.id(found.symmetry.nodes[0]) +
                         " and " + found.id(found.symmetry.nodes[1]) + "; " +
                         std::to_string(found.symmetry.n_unpaired) + " bonds without a partner");
      add_matrix(found, required, no_crossing.empty(), result);
      if (const std::string mismatch = scene_mismatch(found); !mismatch.empty() && !result.empty())
      {
        const auto is_cause = [](const std::string &one) { return one.find(cause_word) == 0; };
        result.erase(std::remove_if(result.begin(), result.end(), is_cause), result.end());
        result.insert(result.begin(), mismatch);
      }
      return result;
    }

    /// One defect, which one number tells: the trace is off at all nodes alike, and nothing by
    /// more.
    bool is_alike(const MomentCheck &moments)
    {
      constexpr double little = .01;
      const double defect = std::abs(moments.mean_ratio - 1);
      return moments.second.value <= (1 + little) * defect &&
             std::all_of(moments.ratios.begin(), moments.ratios.end(),
                         [&](double ratio)
                         { return std::abs(ratio - moments.mean_ratio) <= little * defect; });
    }

    /// What second moments that are off make of an elastic material; empty for scalars.
    template <int dim>
    std::string moduli_verdict(const Findings<dim> &found)
    {
      if (found.elastic.empty())
        return {};
      const auto constant = [&](const std::string &name)
      {
        return *std::find_if(found.elastic.begin(), found.elastic.end(),
                             [&](const auto &one) { return one.name == name; });
      };
      const double anisotropy = constant("anisotropy").median;
      if (!std::isfinite(anisotropy))
        return {};
      std::string text = "discrete elastic moduli (medians over the nodes):";
      for (const std::string name : {"C1111", "C1122", "C1212"})
        text += " " + name + " is off by " +
                base::to_percent(constant(name).median / constant(name).exact - 1) + ",";
      text.back() = ';';
      text += " the anisotropy 2 C1212 / (C1111 - C1122) is " + base::to_text(anisotropy, 4) +
              " instead of 1";
      if (!found.rule.empty() && !found.is_mended &&
          std::abs(found.rule_factor - 1) <= file_tolerance)
        text += "; " + found.rule + " itself has these moduli at m = " +
                base::to_text(found.level.level.horizon / found.level.level.h, 4);
      return text;
    }

    template <int dim>
    std::vector<std::string> interior_verdicts(const Findings<dim> &found)
    {
      const MomentCheck &moments = found.moments;
      std::vector<std::string> result;
      const MomentDefect &first = moments.defects[0];
      if (!found.rule.empty())
        result.push_back((found.is_mended ? "after this correction the weights are those of "
                                          : "the weights are those of ") +
                         found.rule +
                         (std::abs(found.rule_factor - 1) > file_tolerance
                              ? " times " + base::to_text(found.rule_factor, 5)
                              : "") +
                         (found.outliers.empty() ? "" : ", except for the outliers listed below"));
      if (!found.rule_remark.empty())
        result.push_back(found.rule_remark);
      const double exact = std::max(MomentCheck::tolerance, found.precision.moments);
      const bool is_first_exact = first.worst.value <= exact,
                 is_second_exact = moments.second.value <= exact;
      if (!is_first_exact)
        result.push_back("first moments off by up to " + base::to_percent(first.worst.value) +
                         " at node " + found.id(first.worst.node) +
                         ": the operator has a drift there that grows as 1 / horizon");
      if (is_second_exact)
        result.push_back(
            std::string("second moments exact") +
            (is_first_exact ? ": asymptotically compatible (AC) as far as moments tell" : ""));
      else
        result.push_back(
            (moments.typical() > found.precision.moments
                 ? "not asymptotically compatible (not AC): "
                 : std::string()) +
            (is_alike(moments)
                 ? std::string("second moments are off at all nodes alike: their ")
                 : "second moments are off by " + base::to_percent(moments.second.value) +
                       " at node " + found.id(moments.second.node) +
                       " (largest component) and their ") +
            "trace, the strength of the operator, by " + base::to_percent(moments.mean_ratio - 1) +
            (is_alike(moments) ? ": " : " on average: ") + consequence(found));
      if (const std::string moduli = moduli_verdict(found); !is_second_exact && !moduli.empty())
        result.push_back(moduli);
      if (found.n_on_boundary > 0)
        result.push_back(std::to_string(found.n_on_boundary) +
                         " free nodes lie on the boundary of the domain; if they carry data, write "
                         "Methods/nodes = vertices");
      if (found.has_matrix && found.matrix_failure.empty() && found.matrix.is_positive_definite())
        result.push_back(found.nodes.box ? "positive definite with u prescribed around the box"
                                         : "positive definite");
      if (!found.has_matrix)
        result.emplace_back("matrix and solutions are not examined in three dimensions");
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<std::string> complaints(const Findings<dim> &found, const Requirements &required)
  {
    const std::vector<std::string> result = interior_complaints(found, required);
    if constexpr (dim == 2)
      if (found.body)
        return after_body(body_complaints(found, required), result);
    return result;
  }

  bool is_question(const std::string &complaint)
  {
    return complaint.find(question) == 0;
  }

  template <int dim>
  std::vector<std::string> verdicts(const Findings<dim> &found)
  {
    const std::vector<std::string> result = interior_verdicts(found);
    if constexpr (dim == 2)
      if (found.body)
        return after_body(body_verdicts(found), result);
    return result;
  }

  template std::vector<std::string> complaints(const Findings<2> &, const Requirements &);
  template std::vector<std::string> verdicts(const Findings<2> &);
  template std::string text(const Outlier<2> &, const Findings<2> &);

  template std::vector<std::string> complaints(const Findings<3> &, const Requirements &);
  template std::vector<std::string> verdicts(const Findings<3> &);
  template std::string text(const Outlier<3> &, const Findings<3> &);
} // namespace plumbline::check
