#pragma once

#include "geometry/polygon.h"
#include "scene/problem.h"
#include "scene/scene.h"
#include "study/study_results.h"

#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace plumbline::study
{
  /// The comparison cells of a problem, each of convex pieces.
  struct CellPieces
  {
    std::vector<geometry::Polygon> pieces;
    std::vector<std::size_t> cell; ///< of each piece
    std::vector<double> area;      ///< of each cell [length^2]
  };

  CellPieces comparison_pieces(const problem::Problem<2> &problem);

  /// Averages over cells from those over others, by the areas that they share: exact for what is
  /// constant on the others' cells. A cell that the others do not fill takes the mean over what
  /// they do.
  /// @param averages  shape (n_others, n_components)
  /// @return          shape (n_cells, n_components)
  /// @throws NumericalError  a cell that the others do not meet
  std::vector<double> transferred_averages(const CellPieces &others,
                                           const std::vector<double> &averages,
                                           const CellPieces &cells, unsigned int n_components);

  /// ‖u - v‖ in L2 of two fields that are constant on the cells of their problems, exact. Beyond
  /// its cells, in constrained parts of free bodies, a field is 0.
  double distance_across(const CellPieces &cells, const std::vector<double> &u,
                         const CellPieces &others, const std::vector<double> &v,
                         unsigned int n_components);

  /// What records call such distances, with the name of the other method.
  constexpr const char *distance_to_finest = "L2 distance to the finest ";
  constexpr const char *distance_to_reference = "L2 distance to the reference";

  /// Solutions by which a method is held against its own of the finest level.
  class OwnFinest
  {
  public:
    void keep(const Record &run, const problem::Problem<2> &problem,
              const std::vector<double> &averages);

    /// Enters "norm | own finest level" for the scene's norms of averages into all runs of a
    /// method, case and series that were kept, but the finest one; where that is missing, nowhere.
    /// Besides, the distances of fields that are constant on cells from those of all methods at the
    /// finest level.
    void compare(const scene::Scene &scene, std::vector<Record> &runs) const;

  private:
    /// Of a case and series, by level; of a method besides.
    struct Kept
    {
      std::vector<double> averages;
      unsigned int n_components = 0;
    };
    using Place = std::tuple<std::string, std::string, unsigned int>;
    static Place place(const Record &run)
    {
      return {run.key.problem, run.key.series, run.key.level};
    }

    std::map<Place, CellPieces> cells_;
    std::map<std::pair<std::string, Place>, Kept> kept_;
  };
} // namespace plumbline::study
