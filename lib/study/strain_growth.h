#pragma once

#include "method/method.h"
#include "physics/double_well_stability.h"
#include "study/analysis.h"

#include <array>
#include <string>
#include <vector>

// How small waves on a uniform strain of double wells grow: by the symbol of the bonds themselves,
// by the local criterion (64) of Jha & Lipton 2018, doi:10.1137/17M1112236, and in motions.
namespace plumbline::study
{
  /// One amplitude of a strain g × direction.
  struct StrainSample
  {
    double amplitude = 0;         ///< X = β ε g²
    double strain = 0;            ///< g
    std::array<double, 2> wave{}; ///< k of the torus that grows fastest by the symbol, or that is
                                  ///< the nearest to it [1/length]
    double symbol = 0; ///< its rate of growth, √(-λ/ρ) of the nonlocal operator; 0: none [1/time]
    double local = 0; ///< √(4μ/ε²ρ), μ by which (64) fails: of a cone of radius ε [1/time]
  };

  /// What one rule makes of these.
  struct MethodGrowth
  {
    std::string method;
    MethodFamily family = MethodFamily::meshfree;
    std::vector<double> linear;   ///< of its tangent, one for each sample [1/time]
    std::vector<double> observed; ///< of its motion
    std::string failure;          ///< empty, or why there is none
  };

  /// Waves on strains in one direction, on a torus with one horizon.
  struct StrainGrowth
  {
    std::string series, name;  ///< "uniaxial", "biaxial" or "shear"
    double h = 0, horizon = 0; ///< [length]
    physics::Thresholds thresholds;
    double first_wave = 0; ///< the X from which on a wave of this torus grows by the symbol
    std::vector<StrainSample> samples; ///< X rising to 1¼ of what (64) says
    std::vector<MethodGrowth> methods;

    /// max |observed - symbol| over the largest rate of the symbol.
    double difference(const MethodGrowth &of) const;
    /// The same from what its own tangent says.
    double own_difference(const MethodGrowth &of) const;
  };

  /// All directions; methods come by add_growth.
  /// @pre !scene.material.model->is_linear() && scene.domain.is_periodic
  /// Cost: some 3 seconds for each horizon.
  std::vector<StrainGrowth> strain_growths(const scene::Scene &scene, const std::string &series,
                                           const problem::Level &level);

  /// Move every sample's wave by a method. Those without a motion about strains (Galerkin) are left
  /// out.
  /// @param problem  of double wells
  void add_growth(const method::Method &method, const problem::Problem<2> &problem, double density,
                  std::vector<StrainGrowth> &growths);

  /// Variant "NAME strain". Curve "growth": amplitude X, strain, wave (k1, k2), symbol, local,
  /// linear, observed.
  Record strain_record(Record record, const StrainGrowth &growth, const MethodGrowth &one);

  constexpr const char *spectral_radius_of = "spectral radius of "; ///< and the name of a scheme

  /// By how much the fastest growing wave on the largest strain grows in one of the longest steps,
  /// by the method's own tangent: "growth rate" σ [1/time], "growth step" Δt, "growth factor"
  /// exp(σΔt), and for each scheme but Runge-Kutta "spectral radius of SCHEME". Of implicit Euler
  /// it is (65) of Jha & Lipton 2018, see analysis::spectral_radius.
  /// @param record    with the curve "growth"
  /// @param critical  step of central differences at rest, which fractions are of [time]
  void enter_spectral_radii(const scene::TimeSection &time, double critical, Record &record);

  /// The growth of waves on strains at a place by one method: a record for each direction.
  /// @param critical  as above
  Records strain_records(const Place &place, const Method &method, double critical);

  /// Expected/wave growth rates: the largest difference from the symbol of a method over all series
  /// and directions.
  std::vector<Expectation> check_growth(const scene::Scene &scene, const Records &records);
} // namespace plumbline::study
