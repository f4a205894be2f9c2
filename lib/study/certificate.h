#pragma once

#include "method/method.h"
#include "scene/problem.h"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

// Values of static solutions that others can cite: by a Galerkin method with the bound of its own
// error estimate, held against a meshfree rule, which shares no quadrature with it, and its bound.
// Both bounds hold in practice and are not proven.
namespace plumbline::study
{
  /// One of the two ways to a certified value.
  struct CertifiedWay
  {
    std::string method;
    std::vector<double> h; ///< of the levels that value and bound rest on, the finest last [length]
    /// At which its changes fall: observed, and no more than theory says.
    double order = std::numeric_limits<double>::quiet_NaN();
    /// The largest error at the points, where the solution is known; NaN: it is not.
    double error = std::numeric_limits<double>::quiet_NaN();
  };

  struct CertifiedValue
  {
    std::vector<double> x;     ///< one to three coordinates [length]; of the mean over Ω none
    std::vector<double> value; ///< of each component, by the Galerkin method
    double bound = 0;          ///< of the error of any component; NaN: there is none
    std::vector<double> other; ///< by the meshfree rule
    double other_bound = 0;
    unsigned int digits = 0; ///< that the bound leaves certain, relative to Certificate::size
    std::vector<double> exact = {}; ///< where the solution is known; else empty

    double difference() const; ///< of the two ways, the largest of a component
    double error() const;      ///< the largest of a component; NaN: it is not known
    bool has_bounds() const;
    /// Both bounds are known, the values differ by no more than their sum, and the known solution
    /// does not contradict the first one.
    bool is_certain() const;
  };

  /// A meshfree rule held against the certified values, as grade() does with another code's; by
  /// levels, from coarse to fine.
  struct CertifiedRule
  {
    std::string method;
    std::vector<double> h;                         ///< [length]
    std::vector<double> largest, root_mean_square; ///< errors relative to Certificate::size
    std::vector<unsigned int> digits;
    double order = std::numeric_limits<double>::quiet_NaN(); ///< of the errors above the bounds
  };

  struct Certificate
  {
    std::string name, purpose, scene_text; ///< of the scene, as scene::Scene has them
    std::string hash;                      ///< of scene_text: SHA-256, 64 digits
    std::string version;                   ///< of the program
    double horizon = 0;                    ///< [length]
    unsigned int n_components = 1;
    double size = 0; ///< root mean square of the values at the points, of |u| if u is a vector
    CertifiedWay galerkin, meshfree;
    std::vector<CertifiedValue> points;
    std::vector<CertifiedRule> rules;   ///< the one that confirms is the first
    std::optional<CertifiedValue> mean; ///< over Ω; empty: cells do not fill Ω, as about vertices

    /// That two ways do not agree on, or that have no bound; the mean is the last, if it is there.
    std::vector<const CertifiedValue *> refused() const;
    /// Of the points.
    unsigned int least_digits() const;
    /// Digits to which the second way confirms all values: what its values differ by, and its
    /// bound.
    unsigned int confirmed_digits() const;
  };

  /// Both ways; what they find is returned whether they agree or not. Name, hash and version are
  /// left empty.
  /// - Galerkin: one level of the scene, with estimate_error() at the points. The mean's
  /// bound is
  ///   the estimate of the averages' L2 error over √|Ω|, by the inequality of Cauchy and Schwarz.
  /// - Meshfree: the three finest levels. Values at points are fitted to those of nodes, see
  ///   values_by_fit(). The bound is twice the extrapolated error (see grid_convergence()), which
  ///   is the factor of estimates by coarser levels, and at least twice its root mean square over
  ///   all points, see raise_to_mean(); the order is at most 2. No bound: changes do not fall. The
  ///   mean's is the root mean square of the bounds at the points, or its own if that is larger.
  /// @param rules           meshfree; the first one confirms, all are held against the result
  /// @param galerkin_level  from 0, the coarsest
  /// @param points          in the problem's coordinates
  /// @pre  one case, one series with a fixed horizon and at least three levels; at least one rule
  /// @throws NumericalError  there is no solution
  Certificate
  certify(const scene::Scene &scene, const method::Method &galerkin, const method::Methods &rules,
          std::size_t galerkin_level,
          const std::function<std::vector<dealii::Point<2>>(const problem::Problem<2> &)> &points);

  /// In space, where the estimate rests on the changes between 2 h, h and h/2 alone, see
  /// estimate_in_space().
  Certificate
  certify(const scene::Scene &scene, const method::Method &galerkin, const method::Methods &rules,
          std::size_t galerkin_level,
          const std::function<std::vector<dealii::Point<3>>(const problem::Problem<3> &)> &points);

  /// On intervals, see estimate_on_line(). Method and rules are MethodOnIntervals.
  Certificate
  certify(const scene::Scene &scene, const method::Method &galerkin, const method::Methods &rules,
          std::size_t galerkin_level,
          const std::function<std::vector<dealii::Point<1>>(const problem::Problem<1> &)> &points);

  /// @throws InputError  no static problem in one case; not Study/regime = m with at
  /// least three levels; Reference/method or Reference/estimate missing; cracks
  void check_certifiable(const scene::Scene &scene);

  /// The two ways by which a scene's values are certified, see certify().
  struct CertifiedWays
  {
    std::shared_ptr<const method::Method> galerkin; ///< Reference/method
    method::Methods rules;                          ///< those of Methods/names
    std::size_t level = 0;                          ///< of the Galerkin method, from 0
  };

  /// @param reference_level  from 1, the coarsest; 0: the finest
  /// @throws InputError  no such methods or level, or no memory for the two ways
  CertifiedWays certified_ways(const scene::Scene &scene, const method::Methods &available,
                               unsigned int reference_level);
} // namespace plumbline::study
