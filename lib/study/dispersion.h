#pragma once

#include "algebra/symbol.h"
#include "method/method.h"
#include "problem/in_space.h"
#include "study/analysis.h"

#include <string>
#include <utility>
#include <vector>

namespace plumbline::study
{
  /// A wave of one length on a lattice, beside the nonlocal operator's own.
  struct WaveSample
  {
    double k = 0;                            ///< [1/length]
    double phase = 0, group = 0;             ///< ω/k and dω/dk [length/time]; NaN where ω² < 0
    double exact_phase = 0, exact_group = 0; ///< of the nonlocal operator
  };

  /// A direction that waves run in.
  struct WaveDirection
  {
    std::string name;   ///< "at 22.5°" from the first axis; in space "along (1, 1, 0)"
    algebra::Vector3 n; ///< of length 1
  };

  /// Directions of a study as they are asked for; both empty: the usual ones.
  struct AskedDirections
  {
    std::vector<double> angles;            ///< in the plane, from the first axis [degree]
    std::vector<algebra::Vector3> vectors; ///< in space, of any length > 0
  };

  /// Waves of one branch in one direction.
  struct WaveCurve
  {
    std::string name;                ///< e.g. "L waves at 22.5°"
    double local_speed = 0;          ///< c of the local limit [length/time]
    double long_wave_error = 0;      ///< lim ω/k as k → 0, over c, less 1; NaN where ω² < 0
    WaveSample longest;              ///< the longest wave of the domain
    std::vector<WaveSample> samples; ///< short to long; at a series' finest level alone

    double local_error() const { return longest.phase / local_speed - 1; }
    double nonlocal_error() const { return longest.phase / longest.exact_phase - 1; }
  };

  /// The waves of one method at one level of a scene.
  struct DispersionRow
  {
    std::string method;
    MethodFamily family = MethodFamily::meshfree; ///< of the method
    std::string series;
    double h = 0, horizon = 0;     ///< [length]
    std::vector<WaveCurve> curves; ///< for each direction one of each branch
    /// For each branch by name the speed of long waves along an axis less that along the diagonal,
    /// over c; in space that of a face or of the cube, whichever differs more.
    std::vector<std::pair<std::string, double>> anisotropy;
    algebra::SymbolRange range; ///< of ω² [1/time^2]
    double round_off = 0;       ///< of the longest wave's errors
    LimitProof limit;           ///< by moments, or for conforming spaces
    std::string failure;        ///< empty, or why there are no waves
    double seconds = 0; ///< CPU time of all rows of this method and level, in the first of them
    double value = 0;   ///< of DispersionResults::variable

    double m() const { return horizon / h; }
    bool grows() const;                  ///< some wave has ω² < 0
    double critical_step() const;        ///< 2/√max ω², of central differences [time]
    double worst_local_error() const;    ///< over all curves, of the longest wave, absolute
    double worst_nonlocal_error() const; ///< the same
  };

  /// What is asked of a scene's waves.
  struct WaveStudy
  {
    std::vector<WaveDirection> directions;
    double wavelength = 0; ///< the longest one of the domain: the longest side of its box
    double density = 1;    ///< > 0, see scene::TimeSection
  };

  /// The requested directions, or the defaults: in two dimensions along an axis, along the diagonal
  /// and halfway; in space along an axis and along the diagonals of a face and of the cube.
  /// @throws InputError  directions for the other dimension, more than 16, or an invalid one: a
  /// vector that is zero or not finite, an angle not in [-360, 360]
  std::vector<WaveDirection> wave_directions(const AskedDirections &asked, unsigned int dimension);

  /// @throws InputError  a scene without one stencil for all nodes: a mesh, a free body, cracks,
  /// a material that varies; or an operator whose local limit has no waves, ω² <= 0
  WaveStudy plan_waves(const scene::Scene &scene, const AskedDirections &directions = {});

  /// What a method is called with its mass matrix made diagonal.
  inline std::string lumped(const std::string &method)
  {
    return method + " lumped";
  }

  /// One row of a method's own mass matrix, and one more, lumped(NAME), where that couples cells.
  /// @param is_finest  of its series: sampled from 2 to 200 h
  /// Instantiated for dim = 2 and 3.
  template <int dim>
  std::vector<DispersionRow>
  measure_waves(const Method &method, const problem::Problem<dim> &problem, const WaveStudy &study,
                const std::string &series, bool is_finest);

  /// Curve "waves at 22.5°" ("L waves at ..." of a solid), of rows at a series' finest level: k,
  /// phase and group speed, and both of the nonlocal operator. Scalars by the same names.
  Record wave_record(Record record, const DispersionRow &row);

  /// For each method and series how the worst error of the longest wave's phase speed behaves,
  /// against the nonlocal operator's. That tends to the local limit's itself as the horizon falls,
  /// so that in the regime delta a method's waves tend to the right ones if and only if this error
  /// vanishes. Against the local limit errors of rule and horizon may cancel on the way.
  /// @param records  coarse to fine in each series
  std::vector<Trend> wave_trends(const scene::Scene &scene, const Records &records);

  Analysis dispersion_analysis(const AskedDirections &directions = {});
} // namespace plumbline::study
