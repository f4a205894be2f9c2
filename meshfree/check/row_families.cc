#include "meshfree/check/row_families.h"

#include "base/error.h"
#include "base/number_text.h"
#include "meshfree/check/images.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    /// A bond of a node.
    template <int dim>
    struct Row
    {
      unsigned int neighbour;
      Bond<dim> bond;
      std::size_t line;
    };

    /// Why bonds cannot be used, given twice apart.
    /// @return  line and fault of the first row that is wrong, if one is
    template <int dim>
    std::optional<std::pair<std::size_t, std::string>>
    find_fault(const std::vector<GivenRow<dim>> &rows, const NodeIndex &index,
               const std::string &nodes_file)
    {
      for (const GivenRow<dim> &row : rows)
      {
        for (const auto &[name, id] : {std::pair{"i", row.i}, std::pair{"j", row.j}})
          if (!index.find(id))
            return std::pair{row.line, std::string(name) + " = " + std::to_string(id) +
                                           " is no node of '" + nodes_file +
                                           "'; take the bond out, or add the node"};
        if (row.i == row.j)
          return std::pair{row.line, "a bond of node " + std::to_string(row.i) +
                                         " with itself; take it out, it has no part in the "
                                         "operator"};
      }
      return {};
    }

    /// By the first node of the bonds.
    template <int dim>
    std::vector<std::vector<Row<dim>>>
    rows_by_node(const std::vector<GivenRow<dim>> &given, const NodeIndex &index,
                 const GivenNodes<dim> &nodes, const geometry::NodeCells<dim> &cells)
    {
      std::vector<std::vector<Row<dim>>> rows(cells.size());
      const auto add = [&](unsigned int i, unsigned int j, const GivenRow<dim> &row)
      {
        const Point<dim> xi(cells.nodes[j] - cells.nodes[i]);
        rows[i].push_back(
            {j,
             {xi, row.weight, row.kernel_point.value_or(xi), nodes.volume[cells.source[j]]},
             row.line});
      };
      std::optional<NearestImages<dim>> images;
      if (nodes.box)
        images.emplace(nodes, cells);
      for (const GivenRow<dim> &row : given)
      {
        const unsigned int i = *index.find(row.i), j = *index.find(row.j),
                           image = images ? images->nearest(j, i) : j;
        add(i, image, row);
        if (image != j) // the same bond on the other side of the box
          add(images->nearest(i, j), j, row);
      }
      return rows;
    }

    /// Bonds that are too long for the images that there are seem to reach half around the box.
    template <int dim>
    void check_lengths(const std::vector<std::vector<Row<dim>>> &rows, const GivenNodes<dim> &nodes,
                       const RowSource &source)
    {
      if (!nodes.box)
        return;
      for (const std::vector<Row<dim>> &family : rows)
        for (const Row<dim> &row : family)
          for (unsigned int d = 0; d < dim; ++d)
            if (nodes.box->crosses(row.bond.xi, d))
              throw InputError(source.place(row.line) + "this bond is " +
                               base::to_text(row.bond.xi.norm(), 6) +
                               " long, which exceeds half a side of the periodic box and what the "
                               "horizon allows; give the horizon of the bonds (Study), or take "
                               "the bond out");
    }

    /// By neighbour.
    /// @param id  of a cell's node
    template <int dim, class Id>
    void sort_bonds(std::vector<Row<dim>> &rows, std::size_t node, const RowSource &source,
                    const Id &id)
    {
      std::sort(rows.begin(), rows.end(),
                [](const Row<dim> &a, const Row<dim> &b)
                { return std::pair(a.neighbour, a.line) < std::pair(b.neighbour, b.line); });
      const auto twin = std::adjacent_find(rows.begin(), rows.end(),
                                           [](const Row<dim> &a, const Row<dim> &b)
                                           { return a.neighbour == b.neighbour; });
      if (twin != rows.end())
        throw InputError(source.place(twin[1].line) + "the bond from node " + id(node) +
                         " to node " + id(twin->neighbour) + " is that of " + source.unit + " " +
                         std::to_string(twin->line) +
                         " already; take one of them out, or add their weights");
    }
  } // namespace

  template <int dim>
  GivenFamilies<dim>
  families_of_rows(const std::vector<GivenRow<dim>> &given, const GivenNodes<dim> &nodes,
                   const geometry::NodeCells<dim> &cells, const RowSource &source)
  {
    const NodeIndex index(nodes, cells);
    const auto fail_unless_shifted = [&](const std::string &message)
    {
      const std::string shift = shifted_ids(given, index, cells);
      throw InputError(shift.empty() ? message : "'" + source.file + "': " + shift);
    };
    if (const auto fault = find_fault(given, index, nodes.file))
      fail_unless_shifted(source.place(fault->first) + fault->second);
    std::vector<std::vector<Row<dim>>> rows = rows_by_node(given, index, nodes, cells);
    check_lengths(rows, nodes, source);
    const auto id = [&](std::size_t cell) { return std::to_string(nodes.id[cells.source[cell]]); };

    GivenFamilies<dim> result{std::vector<Family<dim>>(cells.n_free)};
    result.unit = source.unit;
    result.lines.resize(cells.n_free);
    result.is_half_list = is_half_list(given, index, cells.n_free);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      sort_bonds(rows[i], i, source, id);
      if (i >= cells.n_free)
      {
        result.n_ignored += nodes.box ? 0 : rows[i].size();
        for (const Row<dim> &row : rows[i])
          result.of_collar.push_back({i, row.neighbour, row.bond, row.line});
        continue;
      }
      if (rows[i].empty() && !result.is_half_list)
        fail_unless_shifted(RowSource{nodes.file, source.unit}.place(nodes.line[cells.source[i]]) +
                            "node " + id(i) + " lies in the domain but has no bonds in '" +
                            source.file +
                            "'; add them, or, where nodes on the boundary carry data, write "
                            "Methods/nodes = vertices");
      for (const Row<dim> &row : rows[i])
      {
        result.families[i].neighbours.push_back(row.neighbour);
        result.families[i].bonds.push_back(row.bond);
        result.lines[i].push_back(row.line);
      }
    }
    return result;
  }

  template GivenFamilies<2> families_of_rows(const std::vector<GivenRow<2>> &,
                                             const GivenNodes<2> &, const geometry::NodeCells<2> &,
                                             const RowSource &);
  template GivenFamilies<3> families_of_rows(const std::vector<GivenRow<3>> &,
                                             const GivenNodes<3> &, const geometry::NodeCells<3> &,
                                             const RowSource &);
} // namespace plumbline::meshfree
