#include "reference/mesh/outer_cells.h"

#include "geometry/search.h"
#include "reference/mesh/rows.h"

#include <algorithm>
#include <map>

namespace plumbline::reference
{
  namespace
  {
    void sort_as_translated(std::size_t cell, const Translations &translations,
                            std::vector<unsigned int> &near)
    {
      std::vector<std::pair<Translations::Pair, unsigned int>> by_place;
      for (const unsigned int other : near)
        by_place.emplace_back(translations.pair(cell, other), other);
      std::sort(by_place.begin(), by_place.end());
      std::transform(by_place.begin(), by_place.end(), near.begin(),
                     [](const auto &one) { return one.second; });
    }

    /// @param is_known  shape (n_dofs), 0 before and after
    void list_dofs(const MeshSpace &space, OuterCell &outer, std::vector<char> &is_known)
    {
      for (const unsigned int cell : outer.near)
        for (unsigned int a = 0; a < space.shapes().size(); ++a)
          if (char &is = is_known[space.dofs(cell)[a]]; is == 0)
          {
            is = 1;
            outer.dofs.push_back(space.dofs(cell)[a]);
          }
      for (const unsigned int dof : outer.dofs)
        is_known[dof] = 0;
      for (unsigned int i = 0; i < outer.dofs.size(); ++i)
        if (!outer.runs.empty() && outer.dofs[i] == outer.dofs[i - 1] + 1)
          ++outer.runs.back().size;
        else
          outer.runs.push_back({outer.dofs[i], i, 1});
      std::sort(outer.runs.begin(), outer.runs.end(),
                [](const auto &a, const auto &b) { return a.dof < b.dof; });
    }
  } // namespace

  std::vector<OuterCell> find_outer(const MeshSpace &space, const MeshCells &cells,
                                    const Translations &translations, double horizon,
                                    const std::vector<geometry::Cut> &cracks,
                                    const std::vector<geometry::Box> &gaps)
  {
    const geometry::BoxSearch<2> gap_search(gaps);
    const dealii::Tensor<1, 2> reach({horizon, horizon});
    std::vector<OuterCell> all(cells.size());
    in_parallel(cells.size(),
                [&](std::size_t first, std::size_t last)
                {
                  std::vector<char> is_known(space.n_dofs());
                  std::vector<geometry::Cut> between;
                  std::vector<unsigned int> found;
                  for (std::size_t cell = first; cell < last; ++cell)
                  {
                    OuterCell &outer = all[cell];
                    outer.cell = static_cast<unsigned int>(cell);
                    cells.find_near(cell, horizon, outer.near);
                    if (translations.has_few_shapes())
                      sort_as_translated(cell, translations, outer.near);
                    list_dofs(space, outer, is_known);
                    const auto own = cells[cell].vertices();
                    const geometry::Box box = geometry::bounding_box(own);
                    gap_search.find({box.lower - reach, box.upper + reach}, found);
                    outer.is_cut = !found.empty() ||
                                   std::any_of(outer.near.begin(), outer.near.end(),
                                               [&](unsigned int other)
                                               {
                                                 return geometry::find_between(
                                                            cracks, own, cells[other].vertices(),
                                                            between) != geometry::Sight::clear;
                                               });
                  }
                });
    all.erase(std::remove_if(all.begin(), all.end(),
                             [&](const OuterCell &outer)
                             { return outer.runs.front().dof >= space.n_free(); }),
              all.end());
    return all;
  }

  std::vector<std::size_t> find_alike(const std::vector<OuterCell> &outer,
                                      const Translations &translations)
  {
    using Surroundings = std::vector<Translations::Pair>;
    std::map<Surroundings, std::size_t> known;
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < outer.size(); ++i)
    {
      if (outer[i].is_cut)
      {
        first.push_back(i);
        continue;
      }
      Surroundings own;
      for (const unsigned int near : outer[i].near)
        own.push_back(translations.pair(outer[i].cell, near));
      first.push_back(known.try_emplace(std::move(own), i).first->second);
    }
    return first;
  }
} // namespace plumbline::reference
