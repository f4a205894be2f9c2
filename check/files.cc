#include "check/files.h"

#include "check/body.h"
#include "check/text.h"
#include "meshfree/check/cells_vtu.h"
#include "meshfree/check/sizes.h"
#include "report/check_page.h"
#include "report/text_table.h"
#include "study/solution_record.h"

#include <cmath>

namespace plumbline::check
{
  using namespace meshfree;
  using report::Table;

  namespace
  {
    /// What there is of each free node.
    template <int dim>
    std::vector<report::NodeField> node_fields(const Findings<dim> &found)
    {
      const std::size_t n = found.cells->n_free;
      const double ball = ball_volume<dim>(found.level.level.horizon);
      std::vector<double> area(n), flags(n);
      for (std::size_t i = 0; i < n; ++i)
      {
        double sum = found.mended_volumes[i];
        for (const Bond<dim> &bond : found.given.families[i].bonds)
          sum += bond.weight;
        area[i] = std::abs(sum / ball - 1);
      }
      std::vector<report::NodeField> fields = {
          {"second_moments", "second moments", found.moments.second_defects},
          {"first_moments", "first moments", found.moments.defects[0].values},
          {"area", "sum of the weights", area}};
      for (std::size_t d = 2; d < found.moments.defects.size(); ++d)
      {
        const std::string degree = std::to_string(found.moments.defects[d].degree);
        fields.push_back(
            {"degree_" + degree, "moments of degree " + degree, found.moments.defects[d].values});
      }
      return fields;
    }

    /// Of each node, how many outliers name it.
    template <int dim>
    std::vector<double> flags(const Findings<dim> &found)
    {
      std::vector<double> result(found.cells->n_free);
      for (const Outlier<dim> &o : found.outliers)
        for (const std::size_t node : {o.node, o.neighbour})
          if (node < result.size())
            ++result[node];
      return result;
    }

    template <int dim>
    Table node_table(const Findings<dim> &found, const std::vector<report::NodeField> &fields)
    {
      Table table;
      table.columns = {"id", "x", "y"};
      if (dim == 3)
        table.columns.emplace_back("z");
      for (const std::string name :
           {"volume", dim == 2 ? "cell_area" : "cell_volume", "bonds", "second_moment_ratio"})
        table.columns.push_back(name);
      for (const report::NodeField &field : fields)
        table.columns.emplace_back(field.name);
      table.columns.emplace_back("outliers");
      const auto n_outliers = flags(found);
      for (std::size_t i = 0; i < found.cells->n_free; ++i)
      {
        std::vector<report::Cell> row = {report::text_cell(found.id(i))};
        for (unsigned int d = 0; d < dim; ++d)
          row.push_back(report::number_cell(found.nodes.origin[d] + found.cells->nodes[i][d]));
        row.push_back(report::number_cell(found.volumes[i]));
        row.push_back(report::number_cell(found.cells->area[i]));
        row.push_back(report::count_cell(found.given.families[i].bonds.size()));
        row.push_back(report::number_cell(found.moments.ratios[i]));
        table.rows.push_back(std::move(row));
        for (const report::NodeField &field : fields)
          table.rows.back().push_back(report::error_cell(field.values[i]));
        table.rows.back().push_back(report::count_cell(static_cast<std::uint64_t>(n_outliers[i])));
      }
      return table;
    }

    template <int dim>
    Table outlier_table(const Findings<dim> &found)
    {
      Table table;
      table.columns = {"node", "neighbour", "line", "found", "expected", "what"};
      for (const Outlier<dim> &o : found.outliers)
        table.rows.push_back(
            {report::text_cell(found.id(o.node)),
             o.neighbour == Outlier<dim>::none ? report::empty_cell()
                                               : report::text_cell(found.id(o.neighbour)),
             o.bond == Outlier<dim>::none ? report::empty_cell()
                                          : report::count_cell(found.given.lines[o.node][o.bond]),
             report::number_cell(o.found), report::number_cell(o.expected),
             report::text_cell(text(o, found))});
      return table;
    }

    template <int dim>
    Table moment_table(const Findings<dim> &found)
    {
      Table table;
      table.columns = {"degree", "worst", "median", "worst at node"};
      for (const MomentDefect &defect : found.moments.defects)
        table.rows.push_back({report::count_cell(static_cast<std::uint64_t>(defect.degree)),
                              report::error_cell(defect.worst.value),
                              report::error_cell(defect.median),
                              report::text_cell(found.id(defect.worst.node))});
      return table;
    }

    template <int dim>
    Table elastic_table(const Findings<dim> &found)
    {
      Table table;
      table.columns = {"constant", "least", "median", "largest", "of the kernel"};
      for (const ElasticRange &one : found.elastic)
        table.rows.push_back({report::text_cell(one.name), report::number_cell(one.least),
                              report::number_cell(one.median), report::number_cell(one.largest),
                              report::number_cell(one.exact)});
      return table;
    }

    template <int dim>
    Table solution_table(const Findings<dim> &found)
    {
      Table table;
      table.columns = {"case", "norm and target", "by the weights", "by the reference"};
      for (const CaseCheck &one : found.cases)
        for (const auto &[name, value] : study::errors_of(one.weights))
          table.rows.push_back(
              {report::text_cell(one.name()), report::text_cell(name), report::error_cell(value),
               report::known(one.reference.has(name), report::error_cell(one.reference[name]))});
      return table;
    }
  } // namespace

  template <int dim>
  void write_check(const Findings<dim> &found, const Requirements &required, const Input &input,
                   int exit_code, const std::filesystem::path &folder)
  {
    const auto fields = node_fields(found);
    report::write_file(folder / "check.json", check_json(found, required, input, exit_code));
    report::write_file(folder / "nodes.csv", report::to_csv(node_table(found, fields)));
    report::write_file(folder / "outliers.csv", report::to_csv(outlier_table(found)));
    std::vector<std::string> names;
    std::vector<double> values;
    for (const report::NodeField &field : fields)
      names.push_back(field.name);
    names.emplace_back("outliers");
    const auto n_outliers = flags(found);
    for (std::size_t i = 0; i < found.cells->n_free; ++i)
    {
      for (const report::NodeField &field : fields)
        values.push_back(field.values[i]);
      values.push_back(n_outliers[i]);
    }
    if constexpr (dim == 2)
      write_cells_vtu(*found.cells, names, values, (folder / "cells.vtu").string());

    report::CheckPage page{found.scene_name,
                           found.purpose,
                           {},
                           complaints(found, required),
                           verdicts(found),
                           {},
                           {},
                           {}};
    page.facts = {std::to_string(found.cells->n_free) + (found.body ? " nodes of the interior"
                                                         : found.nodes.box
                                                             ? " nodes in a periodic box"
                                                             : " free nodes"),
                  std::to_string(found.weights.n_bonds) + " bonds", found.level.text()};
    page.parts = {{"outliers", "Outliers",
                   "Each quantity is compared with its own spread. Found and expected values are "
                   "weights, volumes or moments, as the last column says.",
                   outlier_table(found)},
                  {"moments", "Moments",
                   "Relative difference between the sums over the bonds and the exact moments.",
                   moment_table(found)},
                  {"elastic", "Elastic constants",
                   "Of the nodes' second moments, in the unit of the scene's material.",
                   elastic_table(found)},
                  {"solution", "Solutions",
                   "Errors of the solution of the scene with these weights and with the reference "
                   "[unit of the solution].",
                   solution_table(found)}};
    if constexpr (dim == 2)
      if (found.body)
        page.parts.insert(page.parts.begin(),
                          {"body", "Free surfaces and cracks",
                           "Moments of all families relative to those of the visible part of the "
                           "ball. visible/bulk and weights/bulk are second moments relative to "
                           "those of the bulk. "
                           "All other tables and maps are those of the interior.",
                           body_table(found)});
    for (std::size_t i = 0; i < found.cells->n_free && dim == 2; ++i)
      page.nodes.push_back({found.cells->nodes[i][0], found.cells->nodes[i][1]});
    if (dim == 2) // there is no map of nodes in space
      page.defects = {fields[0], fields[1]};
    report::write_check_page(page, folder);
  }

  template void write_check(const Findings<2> &, const Requirements &, const Input &, int,
                            const std::filesystem::path &);

  template void write_check(const Findings<3> &, const Requirements &, const Input &, int,
                            const std::filesystem::path &);
} // namespace plumbline::check
