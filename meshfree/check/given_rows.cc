#include "meshfree/check/given_rows.h"

#include <algorithm>
#include <array>
#include <set>

namespace plumbline::meshfree
{
  template <int dim>
  NodeIndex::NodeIndex(const GivenNodes<dim> &nodes, const geometry::NodeCells<dim> &cells)
  {
    for (unsigned int k = 0; k < cells.size(); ++k)
      node_of_id_.emplace(nodes.id[cells.source[k]], k); // images follow their nodes
  }

  std::optional<unsigned int> NodeIndex::find(std::int64_t id) const
  {
    const auto found = node_of_id_.find(id);
    return found == node_of_id_.end() ? std::nullopt : std::optional(found->second);
  }

  namespace
  {
    /// Numbers that are added to the ids of the columns i and j.
    using Shift = std::array<std::int64_t, 2>;

    struct Fitness
    {
      std::size_t n_impossible = 0; ///< bonds of unknown nodes or of a node with itself, and free
                                    ///< nodes without bonds
      double mean_length = 0;       ///< of the other bonds
    };

    template <int dim>
    Fitness fitness(const std::vector<GivenRow<dim>> &rows, const Shift &shift,
                    const NodeIndex &index, const geometry::NodeCells<dim> &cells)
    {
      Fitness result;
      std::vector<bool> has_bonds(cells.n_free);
      std::size_t n_bonds = 0;
      for (const GivenRow<dim> &row : rows)
      {
        const auto i = index.find(row.i + shift[0]), j = index.find(row.j + shift[1]);
        if (!i || !j || *i == *j)
        {
          ++result.n_impossible;
          continue;
        }
        if (*i < cells.n_free)
          has_bonds[*i] = true;
        ++n_bonds;
        result.mean_length += cells.nodes[*i].distance(cells.nodes[*j]);
      }
      result.mean_length /= static_cast<double>(std::max<std::size_t>(1, n_bonds));
      result.n_impossible +=
          static_cast<std::size_t>(std::count(has_bonds.begin(), has_bonds.end(), false));
      return result;
    }

    /// "i are one less than", of the ids as they stand.
    std::string shift_text(const Shift &shift)
    {
      const auto less = [](std::int64_t by)
      { return std::string("one ") + (by > 0 ? "less" : "more") + " than"; };
      if (shift[0] == shift[1])
        return "i and j are both " + less(shift[0]);
      if (shift[0] == 0 || shift[1] == 0)
        return std::string(shift[0] == 0 ? "j" : "i") + " are " + less(shift[0] + shift[1]);
      return "i are " + less(shift[0]) + " and those in j are " + less(shift[1]);
    }
  } // namespace

  template <int dim>
  std::string shifted_ids(const std::vector<GivenRow<dim>> &rows, const NodeIndex &index,
                          const geometry::NodeCells<dim> &cells)
  {
    constexpr double shorter = .999;
    const Fitness given = fitness(rows, {0, 0}, index, cells);
    if (given.n_impossible == 0)
      return "";
    std::optional<Shift> best;
    double best_length = 0;
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        if (i != 0 || j != 0)
        {
          const Fitness moved = fitness(rows, {i, j}, index, cells);
          if (moved.n_impossible == 0 && moved.mean_length < shorter * given.mean_length &&
              (!best || moved.mean_length < best_length))
          {
            best = {i, j};
            best_length = moved.mean_length;
          }
        }
    if (!best)
      return "";
    return "the ids in " + shift_text(*best) +
           " those of the nodes: one file counts from 0, the other from 1; with the ids moved by "
           "one all bonds fit; count alike in both files";
  }

  template <int dim>
  bool is_half_list(const std::vector<GivenRow<dim>> &rows, const NodeIndex &index,
                    std::size_t n_free)
  {
    constexpr std::size_t fewest = 20; // bonds that tell
    constexpr double nearly_none = .02;
    std::set<std::pair<unsigned int, unsigned int>> bonds;
    for (const GivenRow<dim> &row : rows)
    {
      const auto i = index.find(row.i), j = index.find(row.j);
      if (i && j && *i < n_free && *j < n_free)
        bonds.insert({*i, *j});
    }
    const auto n_paired = std::count_if(bonds.begin(), bonds.end(),
                                        [&](const auto &bond) {
                                          return bonds.count({bond.second, bond.first}) > 0;
                                        });
    return bonds.size() >= fewest &&
           static_cast<double>(n_paired) <= nearly_none * static_cast<double>(bonds.size());
  }

  template NodeIndex::NodeIndex(const GivenNodes<2> &, const geometry::NodeCells<2> &);
  template NodeIndex::NodeIndex(const GivenNodes<3> &, const geometry::NodeCells<3> &);
  template std::string shifted_ids(const std::vector<GivenRow<2>> &, const NodeIndex &,
                                   const geometry::NodeCells<2> &);
  template std::string shifted_ids(const std::vector<GivenRow<3>> &, const NodeIndex &,
                                   const geometry::NodeCells<3> &);
  template bool is_half_list(const std::vector<GivenRow<2>> &, const NodeIndex &, std::size_t);
  template bool is_half_list(const std::vector<GivenRow<3>> &, const NodeIndex &, std::size_t);
} // namespace plumbline::meshfree
