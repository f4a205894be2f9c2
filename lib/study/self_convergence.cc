#include "study/self_convergence.h"

#include "base/error.h"
#include "geometry/search.h"
#include "study/comparison.h"
#include "study/timing.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::study
{
  using geometry::view;

  namespace
  {
    geometry::Polygon square(const dealii::Point<2> &centre, double h)
    {
      const double r = h / 2, x = centre[0], y = centre[1];
      return {{x - r, y - r}, {x + r, y - r}, {x + r, y + r}, {x - r, y + r}};
    }

    /// Of a cell and another problem's the area that they share, if they do.
    struct Overlap
    {
      std::size_t cell = 0, other = 0;
      double area = 0;
    };
    using Overlaps = std::vector<Overlap>;

    Overlaps overlaps_of(const CellPieces &cells, const CellPieces &others)
    {
      std::vector<geometry::Box> boxes;
      for (const geometry::Polygon &piece : others.pieces)
        boxes.push_back(geometry::bounding_box(view(piece)));
      const geometry::BoxSearch<2> search(std::move(boxes));
      std::vector<unsigned int> found;
      Overlaps result;
      for (std::size_t p = 0; p < cells.pieces.size(); ++p)
      {
        search.find(geometry::bounding_box(view(cells.pieces[p])), found);
        for (const unsigned int other : found)
          if (const auto common =
                  geometry::overlap(view(cells.pieces[p]), view(others.pieces[other]));
              !common.empty())
            result.push_back({cells.cell[p], others.cell[other], geometry::area(view(common))});
      }
      return result;
    }

    std::vector<double> transferred(const Overlaps &overlaps, const std::vector<double> &averages,
                                    std::size_t n_cells, unsigned int n_components)
    {
      std::vector<double> sum(n_cells * n_components), shared(n_cells);
      for (const auto &[cell, other, area] : overlaps)
      {
        shared[cell] += area;
        for (unsigned int c = 0; c < n_components; ++c)
          sum[cell * n_components + c] += area * averages[other * n_components + c];
      }
      for (std::size_t i = 0; i < sum.size(); ++i)
      {
        if (!(shared[i / n_components] > 0))
        {
          std::ostringstream message;
          message << "cells of the finest level do not overlap a coarser level's cell "
                  << i / n_components << ", so the two cannot be compared; let all levels fill "
                  << "the same domain (Domain/mesh, Methods/nodes)";
          throw NumericalError(message.str());
        }
        sum[i] /= shared[i / n_components];
      }
      return sum;
    }

    double distance(const Overlaps &overlaps, const CellPieces &cells, const std::vector<double> &u,
                    const CellPieces &others, const std::vector<double> &v,
                    unsigned int n_components)
    {
      const auto square = [n = n_components](const double *a, const double *b)
      {
        double sum = 0;
        for (unsigned int c = 0; c < n; ++c)
          sum += (a[c] - b[c]) * (a[c] - b[c]);
        return sum;
      };
      std::vector<double> alone = cells.area, others_alone = others.area;
      double sum = 0;
      for (const auto &[cell, other, area] : overlaps)
      {
        sum += area * square(&u[cell * n_components], &v[other * n_components]);
        alone[cell] -= area;
        others_alone[other] -= area;
      }
      const std::vector<double> zero(n_components);
      for (std::size_t i = 0; i < alone.size(); ++i)
        sum += std::max(0., alone[i]) * square(&u[i * n_components], zero.data());
      for (std::size_t i = 0; i < others_alone.size(); ++i)
        sum += std::max(0., others_alone[i]) * square(&v[i * n_components], zero.data());
      return std::sqrt(sum);
    }
  } // namespace

  CellPieces comparison_pieces(const problem::Problem<2> &problem)
  {
    CellPieces result;
    if (!problem.cells())
    {
      for (const dealii::Point<2> &centre : comparison_points(problem))
      {
        result.cell.push_back(result.pieces.size());
        result.pieces.push_back(square(centre, problem.h));
        result.area.push_back(problem.h * problem.h);
      }
      return result;
    }
    const geometry::NodeCells<2> &cells = *problem.cells();
    for (std::size_t c = 0; c < cells.n_free; ++c)
    {
      result.area.push_back(cells.area[c]);
      for (std::size_t p = cells.first_piece[c]; p < cells.first_piece[c + 1]; ++p)
      {
        result.cell.push_back(c);
        result.pieces.push_back(cells.pieces[p]);
      }
    }
    return result;
  }

  std::vector<double> transferred_averages(const CellPieces &others,
                                           const std::vector<double> &averages,
                                           const CellPieces &cells, unsigned int n_components)
  {
    return transferred(overlaps_of(cells, others), averages, cells.area.size(), n_components);
  }

  double distance_across(const CellPieces &cells, const std::vector<double> &u,
                         const CellPieces &others, const std::vector<double> &v,
                         unsigned int n_components)
  {
    return distance(overlaps_of(cells, others), cells, u, others, v, n_components);
  }

  void OwnFinest::keep(const Record &run, const problem::Problem<2> &problem,
                       const std::vector<double> &averages)
  {
    if (cells_.count(place(run)) == 0)
      cells_[place(run)] = comparison_pieces(problem);
    kept_[{run.key.method, place(run)}] = {averages, problem.n_components};
  }

  void OwnFinest::compare(const scene::Scene &scene, std::vector<Record> &runs) const
  {
    std::map<std::pair<Place, Place>, Overlaps> overlaps; // of cells with those of a finest level
    for (Record &run : runs)
    {
      const auto own = kept_.find({run.key.method, place(run)});
      auto finest = place(run);
      for (const Record &other : runs)
        if (is_same_run(other, run.key.method, run.key.problem, run.key.series, other.key.level))
          std::get<2>(finest) = std::max(std::get<2>(finest), other.key.level);
      const auto target = kept_.find({run.key.method, finest});
      if (own == kept_.end() || target == kept_.end() || own == target)
        continue;
      const CellPieces &cells = cells_.at(place(run));
      const auto [averages, n] = own->second;
      auto shared = overlaps.find({place(run), finest});
      if (shared == overlaps.end())
        shared =
            overlaps.emplace(std::pair(place(run), finest), overlaps_of(cells, cells_.at(finest)))
                .first;
      const auto fine = transferred(shared->second, target->second.averages, cells.area.size(), n);
      double largest = 0, squares = 0;
      for (std::size_t i = 0; i < fine.size(); ++i)
      {
        const double difference = averages[i] - fine[i];
        largest = std::max(largest, std::abs(difference));
        squares += difference * difference * cells.area[i / n];
      }
      for (const scene::Norm norm : scene.study.norms)
        if (scene::quantity(norm) == scene::Quantity::averages)
          run.set(scene::DecisiveError{norm, scene::Target::finest}.text(),
                  scene::is_largest(norm) ? largest : std::sqrt(squares));
      for (const auto &[whose, other] : kept_)
        if (whose.second == finest)
          run.set(distance_to_finest + whose.first,
                  distance(shared->second, cells, averages, cells_.at(finest), other.averages, n));
    }
  }
} // namespace plumbline::study
