// Sample points against those of Stokhos of Trilinos, whose Gauss rules are its own, too.
#include "uq/sample_points.h"

#include <Stokhos_HermiteBasis.hpp>
#include <Stokhos_LegendreBasis.hpp>
#include <Stokhos_TensorProductBasis.hpp>
#include <Stokhos_TotalOrderBasis.hpp>
// what these two need stands above
#include <Stokhos_SmolyakBasis.hpp>
#include <Stokhos_SmolyakSparseGridQuadrature.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
  using namespace plumbline::uq;
  using Basis = Stokhos::OneDOrthogPolyBasis<int, double>;
  using Teuchos::RCP;

  RCP<const Basis> basis_of(Law law, int order)
  {
    if (law == Law::normal)
      return Teuchos::rcp(
          new Stokhos::HermiteBasis<int, double>(order, true, Stokhos::MODERATE_GROWTH));
    return Teuchos::rcp(
        new Stokhos::LegendreBasis<int, double>(order, true, Stokhos::MODERATE_GROWTH));
  }

  struct Weighted
  {
    std::vector<double> x;
    double weight = 0;
  };

  /// By their coordinates, of which those that differ by rounding are one.
  std::vector<Weighted> sorted(std::vector<Weighted> points)
  {
    constexpr double rounding = 1e-9;
    for (Weighted &one : points)
      for (double &x : one.x)
        x = std::round(x / rounding) * rounding;
    std::sort(points.begin(), points.end(), [](const auto &a, const auto &b) { return a.x < b.x; });
    return points;
  }

  std::vector<Weighted> ours(const SamplePoints &rule)
  {
    std::vector<Weighted> points;
    for (std::size_t i = 0; i < rule.points.size(); ++i)
      points.push_back({rule.points[i], rule.weights[i]});
    return sorted(points);
  }

  void expect_same(const std::vector<Weighted> &a, const std::vector<Weighted> &b,
                   const std::string &what)
  {
    ASSERT_EQ(a.size(), b.size()) << what;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      for (std::size_t d = 0; d < a[i].x.size(); ++d)
        EXPECT_NEAR(a[i].x[d], b[i].x[d], 3e-9) << what;
      EXPECT_NEAR(a[i].weight, b[i].weight, 1e-12) << what;
    }
  }
} // namespace

TEST(Stokhos, HasTheSameGaussPoints)
{
  for (const Law law : {Law::normal, Law::uniform})
    for (const int n : {1, 2, 3, 8, 15})
    {
      Teuchos::Array<double> x, w;
      Teuchos::Array<Teuchos::Array<double>> values;
      basis_of(law, n)->getQuadPoints(2 * n - 1, x, w, values);
      std::vector<Weighted> points;
      for (int i = 0; i < x.size(); ++i)
        points.push_back({{x[i]}, w[i]});
      expect_same(ours(tensor_points({law}, static_cast<unsigned int>(n))), sorted(points),
                  std::to_string(n) + " points");
    }
}

TEST(Stokhos, HasTheSameSparseCombinations)
{
  for (const int n_variables : {2, 3, 20})
    for (const int level : {1, 2})
    {
      const std::vector<Law> laws(static_cast<std::size_t>(n_variables), Law::normal);
      Teuchos::Array<RCP<const Basis>> bases(n_variables);
      std::fill(bases.begin(), bases.end(), basis_of(Law::normal, level));
      const Stokhos::SmolyakSparseGridQuadrature<int, double> theirs(
          Teuchos::rcp(new Stokhos::TotalOrderBasis<int, double>(bases)),
          Stokhos::TotalOrderIndexSet<int>(n_variables, level));
      std::vector<Weighted> points;
      for (int i = 0; i < theirs.size(); ++i)
      {
        const auto &x = theirs.getQuadPoints()[i];
        if (const double weight = theirs.getQuadWeights()[i]; std::abs(weight) > 1e-14)
          points.push_back({{x.begin(), x.end()}, weight}); // those that cancel are not ours
      }
      expect_same(ours(smolyak_points(laws, static_cast<unsigned int>(level), Growth::odd)),
                  sorted(points),
                  std::to_string(n_variables) + " variables, level " + std::to_string(level));
    }
}
