#include "check/text.h"

#include "base/number_text.h"
#include "check/body.h"
#include "meshfree/check/sizes.h"
#include "report/text_table.h"
#include "report/view.h"
#include "study/solution_record.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace plumbline::check
{
  using namespace meshfree;
  using Json = nlohmann::ordered_json;

  const char *const not_checked_in_space = "not checked in three dimensions: matrix, solutions\n";

  namespace
  {
    constexpr std::size_t n_columns = report::summary_columns;
    constexpr double round_off = 1e-10; // of sums that are printed with three digits

    /// Nodes of Ω.
    template <int dim>
    std::size_t n_of_domain(const Findings<dim> &found)
    {
      return found.body ? found.body->n_families : found.cells->n_free;
    }

    template <int dim>
    void tell_body(std::ostream &out, const Findings<dim> &found)
    {
      if constexpr (dim == 2)
        if (found.body)
          out << report::to_text(body_table(found), n_columns)
              << "moments below are those of the interior; solutions are not compared\n";
    }

    template <int dim>
    void tell_nodes(std::ostream &out, const Findings<dim> &found, const Input &input)
    {
      const std::size_t n_free = n_of_domain(found);
      const std::string measure = std::string(meshfree::measure<dim>()) + "s";
      out << "nodes     " << input.nodes_file << ": " << n_free;
      if (found.nodes.box)
        out << " in the periodic box";
      else
        out << " free, " << found.ids.size() - n_free << " in the interaction domain";
      out << "; volumes "
          << (std::abs(found.volume_defect) < round_off
                  ? "equal the cells' " + measure
                  : "differ from the cells' " + measure + " by " +
                        base::to_percent(found.volume_defect))
          << '\n'
          << "bonds     " << input.bonds_file << ": "
          << (found.body ? found.body->n_bonds : found.weights.n_bonds) << ", at most "
          << found.weights.largest_family << " of a node";
      if (found.given.n_ignored > 0)
        out << "; " << found.given.n_ignored << " of collar nodes ignored";
      out << "\nlevel     " << found.level.text() << ", nearest to the nodes' spacing "
          << found.level.node_size << '\n';
      for (const std::string &note : found.notes)
        out << "read      " << note << '\n';
    }

    template <int dim>
    void tell_moments(std::ostream &out, const Findings<dim> &found)
    {
      out << "moments   degree  worst       median      worst at\n";
      for (const MomentDefect &defect : found.moments.defects)
        out << "          " << std::left << std::setw(8) << defect.degree << std::setw(12)
            << defect.worst.value << std::setw(12) << defect.median << "node "
            << found.ids[defect.worst.node] << '\n';
      out << "          reproduces polynomials up to degree " << found.moments.exact_degree
          << " (to " << MomentCheck::tolerance << ")\n";
    }

    bool is_isotropic(const std::string &modulus)
    {
      const std::array<std::string, 2> names = {"E", "nu"};
      return std::find(names.begin(), names.end(), modulus) != names.end();
    }

    /// One line for E and nu, before what a short summary cuts off.
    template <int dim>
    void tell_moduli(std::ostream &out, const Findings<dim> &found)
    {
      std::string text;
      for (const ElasticRange &one : found.elastic)
        if (dim == 3 && is_isotropic(one.name))
          text += (text.empty() ? "" : ", ") + one.name + " = " + base::to_text(one.median, 4);
        else if (const std::size_t state = one.name.find(", plane"); state != std::string::npos)
        {
          const bool is_first = one.name[0] == 'E';
          text += (text.empty() ? ""
                   : is_first   ? "; "
                                : ", ") +
                  (is_first ? one.name.substr(state + 2) + ": E = " : std::string("nu = ")) +
                  base::to_text(one.median, 4);
        }
      if (!text.empty())
        out << "moduli    " << text << " (medians over the nodes)\n";
    }

    template <int dim>
    void tell_elastic(std::ostream &out, const Findings<dim> &found)
    {
      if (found.elastic.empty())
        return;
      out << "elastic   constant          least       median      largest     of the kernel\n";
      for (const ElasticRange &one : found.elastic)
        out << "          " << std::left << std::setw(18) << one.name << std::setw(12) << one.least
            << std::setw(12) << one.median << std::setw(12) << one.largest << one.exact << '\n';
    }

    template <int dim>
    void tell_operator(std::ostream &out, const Findings<dim> &found)
    {
      const auto id = [&](std::size_t node) { return found.ids[node]; };
      out << "weights   " << found.weights.n_negative << " negative, "
          << found.weights.smallest_ratio << " to " << found.weights.largest_ratio
          << " of the neighbour's volume\n"
          << "          sum off the ball without the node's own cell by "
          << base::to_percent(found.weights.area.value) << " at worst, at node "
          << id(found.weights.area.node) << '\n'
          << "symmetry  w C of a pair differs from end to end by "
          << base::to_percent(found.symmetry.asymmetry) << " of the largest";
      if (found.symmetry.asymmetry > 0)
        out << ", between nodes " << id(found.symmetry.nodes[0]) << " and "
            << id(found.symmetry.nodes[1]);
      out << "\n          V_i w_ij C and V_j w_ji C by "
          << base::to_percent(found.symmetry.imbalance) << "; " << found.symmetry.n_unpaired
          << " bonds without a partner\n";
      if (!found.has_matrix)
        return;
      out << "matrix    " << found.matrix.n_positive
          << " rows with positive off-diagonal entries (no M-matrix if any), "
          << found.matrix.n_weak << " not diagonally dominant\n"
          << "          symmetric part: " << found.matrix.n_negative_eigenvalues
          << " negative eigenvalues, the smallest is " << found.matrix.smallest_eigenvalue << '\n';
    }

    void tell_solution(std::ostream &out, const CaseCheck &one)
    {
      std::string head = "solution  " + one.name() + ": ";
      if (!one.weights.failure.empty())
        out << report::wrapped(head + "none, " + one.weights.failure, n_columns, 10) << '\n';
      for (const auto &[name, value] : study::errors_of(one.weights))
      {
        out << head << name << ' ' << value;
        if (one.reference.has(name))
          out << ", by " << one.reference.key.method << ' ' << one.reference[name];
        out << '\n';
        head = std::string(10, ' ');
      }
    }
  } // namespace

  std::string check_summary(const std::string &body, const std::vector<std::string> &sentences,
                            const std::string &answer, const std::string &elsewhere)
  {
    constexpr std::size_t most = 15, indent = 2;
    const std::string where = "lines " + elsewhere;
    const auto lines_of_each = [&](std::size_t n)
    {
      std::vector<std::string> lines;
      for (const std::string &sentence : sentences)
        for (const std::string &line : report::short_lines(sentence, n, indent))
          lines.push_back(report::fitted(line, n_columns));
      return lines;
    };
    std::vector<std::string> end = lines_of_each(most);
    if (end.size() > most)
      end = report::first_lines(lines_of_each(1), most, where);
    end.push_back(answer);
    std::vector<std::string> lines;
    for (const std::string &line : report::lines_of(body))
      for (const std::string &part :
           report::lines_of(report::wrapped(line, n_columns, indent) + '\n'))
        lines.push_back(part);
    std::string text;
    for (const std::string &line :
         report::first_lines(lines, report::summary_lines - end.size() - 1, where))
      text += line + '\n';
    text += '\n';
    for (const std::string &line : end)
      text += line + '\n';
    return text;
  }

  template <int dim>
  std::string check_text(const Findings<dim> &found, const Requirements &required,
                         const Input &input, const std::string &page)
  {
    std::ostringstream out;
    out << std::setprecision(4) << "report    " << page << '\n';
    tell_body(out, found);
    tell_nodes(out, found, input);
    tell_moduli(out, found);
    tell_moments(out, found);
    tell_elastic(out, found);
    for (const CaseCheck &one : found.cases)
      tell_solution(out, one);
    tell_operator(out, found);
    std::vector<std::string> sentences = verdicts(found);
    const auto wrong = complaints(found, required);
    // what all else hangs on comes first
    const auto others = wrong.begin() + (!wrong.empty() && is_question(wrong.front()) ? 1 : 0);
    sentences.insert(sentences.end(), others, wrong.end());
    sentences.insert(sentences.begin(), wrong.begin(), others);
    return check_summary(out.str(), sentences, wrong.empty() ? "as required" : "NOT as required");
  }

  namespace
  {
    template <int dim>
    Json to_json(const Worst &worst, const Findings<dim> &found)
    {
      return {{"value", worst.value}, {"node", found.ids[worst.node]}};
    }

    template <int dim>
    void add_sizes(Json &json, const Findings<dim> &found)
    {
      json["n_free"] = n_of_domain(found);
      json["n_collar"] = found.ids.size() - n_of_domain(found) - found.nodes.n_images;
      json["n_bonds"] = found.body ? found.body->n_bonds : found.weights.n_bonds;
      json["n_ignored_bonds"] = found.given.n_ignored;
      json["largest_family"] = found.weights.largest_family;
      json["series"] = found.level.series;
      json["h"] = found.level.level.h;
      json["horizon"] = found.level.level.horizon;
      json["node_size"] = found.level.node_size;
      json["volume_defect"] = found.volume_defect;
      json["volume_factor"] = found.volume_factor;
      json["notes"] = found.notes;
    }

    template <int dim>
    void add_moments(Json &json, const Findings<dim> &found)
    {
      for (const MomentDefect &defect : found.moments.defects)
        json["moments"].push_back({{"degree", defect.degree},
                                   {"worst", to_json(defect.worst, found)},
                                   {"median", defect.median}});
      json["exact_degree"] = found.moments.exact_degree;
      json["second_moment"] = {{"mean_ratio", found.moments.mean_ratio},
                               {"worst", to_json(found.moments.second, found)}};
      for (const ElasticRange &one : found.elastic)
        json["elastic"][one.name] = {{"least", one.least},
                                     {"median", one.median},
                                     {"largest", one.largest},
                                     {"exact", one.exact}};
    }

    /// What the weights are, and what may be wrong with them.
    template <int dim>
    void add_causes(Json &json, const Findings<dim> &found)
    {
      json["rule"] = found.rule.empty() ? Json()
                                        : Json{{"name", found.rule},
                                               {"factor", found.rule_factor},
                                               {"remark", found.rule_remark}};
      json["causes"] = Json::array();
      for (const Cause &cause : found.causes)
        json["causes"].push_back({{"name", cause.name},
                                  {"text", cause.text},
                                  {"factor", cause.factor},
                                  {"defect_before", cause.before},
                                  {"defect_after", cause.after},
                                  {"worst_before", cause.worst_before},
                                  {"worst_after", cause.worst_after}});
      json["outliers"] = Json::array();
      for (const Outlier<dim> &o : found.outliers)
        json["outliers"].push_back(
            {{"node", found.ids[o.node]},
             {"neighbour",
              o.neighbour == Outlier<dim>::none ? Json() : Json(found.ids[o.neighbour])},
             {"line",
              o.bond == Outlier<dim>::none ? Json() : Json(found.given.lines[o.node][o.bond])},
             {"found", o.found},
             {"expected", o.expected},
             {"text", text(o, found)}});
    }

    template <int dim>
    void add_operator(Json &json, const Findings<dim> &found)
    {
      json["weights"] = {{"n_negative", found.weights.n_negative},
                         {"smallest_ratio", found.weights.smallest_ratio},
                         {"largest_ratio", found.weights.largest_ratio},
                         {"area_defect", to_json(found.weights.area, found)}};
      json["symmetry"] = {
          {"asymmetry", found.symmetry.asymmetry},
          {"imbalance", found.symmetry.imbalance},
          {"nodes", {found.ids[found.symmetry.nodes[0]], found.ids[found.symmetry.nodes[1]]}},
          {"n_unpaired", found.symmetry.n_unpaired}};
      if (found.has_matrix)
        json["matrix"] = {{"n_rows_with_positive_entries", found.matrix.n_positive},
                          {"n_rows_not_dominant", found.matrix.n_weak},
                          {"n_negative_eigenvalues", found.matrix.n_negative_eigenvalues},
                          {"smallest_eigenvalue", found.matrix.smallest_eigenvalue}};
    }

    template <int dim>
    void add_solutions(Json &json, const Findings<dim> &found)
    {
      for (const CaseCheck &one : found.cases)
        json["solutions"].push_back({{"case", one.name()},
                                     {"failure", one.weights.failure},
                                     {"errors", study::errors_of(one.weights)},
                                     {"reference", one.reference.key.method},
                                     {"reference_errors", study::errors_of(one.reference)}});
    }
  } // namespace

  template <int dim>
  std::string check_json(const Findings<dim> &found, const Requirements &required,
                         const Input &input, int exit_code)
  {
    Json json = {{"schema", check_schema},
                 {"nodes", input.nodes_file},
                 {"bonds", input.bonds_file},
                 {"scene", input.scene_file}};
    add_sizes(json, found);
    if constexpr (dim == 2)
      if (found.body)
        json["body"] = Json::parse(body_json(found));
    add_moments(json, found);
    add_causes(json, found);
    add_operator(json, found);
    add_solutions(json, found);
    json["verdicts"] = verdicts(found);
    json["complaints"] = complaints(found, required);
    json["exit_code"] = exit_code;
    return json.dump(2) + '\n';
  }

  template std::string check_text(const Findings<2> &, const Requirements &, const Input &,
                                  const std::string &);
  template std::string check_json(const Findings<2> &, const Requirements &, const Input &, int);

  template std::string check_text(const Findings<3> &, const Requirements &, const Input &,
                                  const std::string &);
  template std::string check_json(const Findings<3> &, const Requirements &, const Input &, int);
} // namespace plumbline::check
