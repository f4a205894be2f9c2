#include "reference/shapes.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::reference
{
  namespace
  {
    std::shared_ptr<const dealii::FiniteElement<1>> make_element(bool is_continuous,
                                                                 unsigned int degree)
    {
      if (is_continuous)
        return std::make_shared<dealii::FE_Q<1>>(degree);
      return std::make_shared<dealii::FE_DGQ<1>>(degree);
    }
  } // namespace

  AxisShapes::AxisShapes(bool is_continuous, unsigned int degree)
      : is_continuous_(is_continuous), degree_(degree),
        element_(make_element(is_continuous, degree))
  {
    const auto &points = element_->get_unit_support_points();
    deal_index_.resize(points.size());
    std::iota(deal_index_.begin(), deal_index_.end(), 0u);
    std::sort(deal_index_.begin(), deal_index_.end(),
              [&](unsigned int a, unsigned int b) { return points[a][0] < points[b][0]; });
    for (const unsigned int index : deal_index_)
      support_points_.push_back(points[index][0]);

    if (is_continuous)
      families_.push_back({0, true, 0});
    for (unsigned int a = is_continuous ? 1 : 0; a < (is_continuous ? degree : degree + 1); ++a)
      families_.push_back({support_points_[a], false, degree - a});
  }

  double AxisShapes::value(unsigned int a, double x) const
  {
    return element_->shape_value(deal_index_[a], dealii::Point<1>(x));
  }

  double AxisShapes::derivative(unsigned int a, double x) const
  {
    return element_->shape_grad(deal_index_[a], dealii::Point<1>(x))[0];
  }

  AxisShapes::Owner AxisShapes::owner(unsigned int a) const
  {
    if (is_continuous_ && a == degree_)
      return {0, 1};
    return {a, 0};
  }

  std::vector<AxisShapes::Restriction> AxisShapes::restrictions(unsigned int family) const
  {
    if (is_continuous_ && family == 0)
      return {{-1, degree_}, {0, 0}};
    return {{0, family}};
  }

  Correlations::Correlations(const AxisShapes &shapes)
      : shapes_(shapes), n_families_(static_cast<unsigned int>(shapes.families().size())),
        n_modes_(2 * shapes.degree() + 2),
        series_(static_cast<std::size_t>(n_families_) * n_families_ * n_intervals)
  {
    const dealii::QGauss<1> gauss(n_modes_);
    std::vector<double> modes(n_modes_);
    for (unsigned int s = 0; s < n_families_; ++s)
      for (unsigned int t = 0; t < n_families_; ++t)
        for (int i = 0; i < n_intervals; ++i)
        {
          std::vector<double> series(n_modes_);
          for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            const double x = gauss.point(q)[0];
            const double r = (*this)(s, t, first_interval + i + x);
            legendre(2 * x - 1, n_modes_, modes.data());
            for (unsigned int n = 0; n < n_modes_; ++n)
              series[n] += gauss.weight(q) * (2 * n + 1) * modes[n] * r;
          }
          if (std::any_of(series.begin(), series.end(), [](double c) { return c != 0; }))
            series_[(s * n_families_ + t) * n_intervals + i] = series;
        }
  }

  const double *Correlations::coefficients(unsigned int s, unsigned int t, int j) const
  {
    const int i = j - first_interval;
    if (i < 0 || i >= n_intervals)
      return nullptr;
    const auto &series = series_[(s * n_families_ + t) * n_intervals + i];
    return series.empty() ? nullptr : series.data();
  }

  double Correlations::operator()(unsigned int s, unsigned int t, double tau) const
  {
    const dealii::QGauss<1> gauss(shapes_.degree() + 1);
    double sum = 0;
    for (const auto &left : shapes_.restrictions(s))
      for (const auto &right : shapes_.restrictions(t))
      {
        const double from = std::max<double>(left.cell, right.cell - tau);
        const double to = std::min<double>(left.cell + 1, right.cell + 1 - tau);
        for (unsigned int q = 0; q < gauss.size() && from < to; ++q)
        {
          const double x = from + (to - from) * gauss.point(q)[0];
          sum += gauss.weight(q) * (to - from) * shapes_.value(left.local, x - left.cell) *
                 shapes_.value(right.local, x + tau - right.cell);
        }
      }
    return sum;
  }

  void legendre(double x, unsigned int n, double *values)
  {
    values[0] = 1;
    if (n > 1)
      values[1] = x;
    for (unsigned int k = 2; k < n; ++k)
      values[k] = ((2 * k - 1) * x * values[k - 1] - (k - 1) * values[k - 2]) / k;
  }
} // namespace plumbline::reference
