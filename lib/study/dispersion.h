#pragma once

#include "algebra/symbol.h"
#include "method/method.h"
#include "physics/waves.h"
#include "study/analysis.h"

namespace plumbline::study
{
  /// A wave of one length on a lattice, beside the nonlocal operator's own.
  struct WaveSample
  {
    double k = 0;                            ///< [1/length]
    double phase = 0, group = 0;             ///< ω/k and dω/dk [length/time]; NaN where ω² < 0
    double exact_phase = 0, exact_group = 0; ///< of the nonlocal operator
  };

  /// Waves of one polarisation in one direction.
  struct WaveCurve
  {
    physics::Polarisation polarisation = physics::Polarisation::scalar;
    double angle = 0;                ///< from the first axis [degree]
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
    std::vector<WaveCurve> curves; ///< for each direction one of each polarisation
    /// For each polarisation the speed of long waves along an axis less that along the diagonal,
    /// over c.
    std::vector<double> anisotropy;
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
    std::vector<double> angles; ///< [degree]
    double wavelength = 0;      ///< the longest one of the domain: the longer side of its box
    double density = 1;         ///< > 0, see scene::TimeSection
  };

  /// @throws InputError  a scene without one stencil for all nodes: a mesh, a free body, cracks,
  /// a material that varies; or an operator whose local limit has no waves, ω² <= 0
  WaveStudy plan_waves(const scene::Scene &scene, const std::vector<double> &angles);

  /// What a method is called with its mass matrix made diagonal.
  inline std::string lumped(const std::string &method)
  {
    return method + " lumped";
  }

  /// One row of a method's own mass matrix, and one more, lumped(NAME), where that couples cells.
  /// @param is_finest  of its series: sampled from 2 to 200 h
  std::vector<DispersionRow> measure_waves(const Method &method, const problem::Problem<2> &problem,
                                           const WaveStudy &study, const std::string &series,
                                           bool is_finest);

  /// Curve "waves at ANGLE°" ("L waves at ..." of a solid), of rows at a series' finest level: k,
  /// phase and group speed, and both of the nonlocal operator. Scalars by the same names.
  Record wave_record(Record record, const DispersionRow &row);

  /// For each method and series how the worst error of the longest wave's phase speed behaves,
  /// against the nonlocal operator's. That tends to the local limit's itself as the horizon falls,
  /// so that in the regime delta a method's waves tend to the right ones if and only if this error
  /// vanishes. Against the local limit errors of rule and horizon may cancel on the way.
  /// @param records  coarse to fine in each series
  std::vector<Trend> wave_trends(const scene::Scene &scene, const Records &records);

  /// Waves in directions of a scene [degree].
  /// @throws InputError  none, too many, or no angles
  Analysis dispersion_analysis(const std::vector<double> &angles);

  /// Along an axis, along the diagonal, and halfway.
  extern const std::vector<double> usual_angles;
} // namespace plumbline::study
