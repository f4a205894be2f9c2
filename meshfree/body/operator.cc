#include "meshfree/body/operator.h"

#include "base/error.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::meshfree
{
  using algebra::Convolution;
  using algebra::OperatorBackend;
  using algebra::Stencil;
  using algebra::Vector;

  namespace
  {
    /// A node whose family has less than this share of a whole one's second moment has none.
    constexpr double least_family = 1e-12;

    [[noreturn]] void refuse(const VariationalBody &body, std::size_t i, const std::string &what,
                             double value, const std::string &allowed)
    {
      std::ostringstream message;
      message << what << " = " << value << " at the node (" << body.node(i) << "), but it must be "
              << allowed;
      throw InputError(message.str());
    }

    void check(const VariationalBody &body, const Bonds<2> &bonds)
    {
      if (!(std::abs(bonds.h - body.h) <= 1e-12 * body.h))
      {
        std::ostringstream message;
        message << "the bonds are of a lattice of size h = " << bonds.h << ", but the body's is "
                << body.h << "; make the bonds for the body's lattice";
        throw InputError(message.str());
      }
      for (std::size_t i = 0; i < body.size(); ++i)
      {
        if (!(body.V[i] >= 0 && body.V[i] <= body.h * body.h * (1 + 1e-10)))
          refuse(body, i, "the cell's area V", body.V[i], "between 0 and h^2");
        if (body.V[i] > 0 && !(body.k[i] > 0 && std::isfinite(body.k[i])))
          refuse(body, i, "the bulk constant k", body.k[i], "positive");
        if (body.V[i] > 0 && !(body.l[i] > 0 && std::isfinite(body.l[i])))
          refuse(body, i, "the shear constant l", body.l[i], "positive");
      }
    }

    std::variant<Convolution, DirectSums> make_sums(const Stencil &stencil, std::array<int, 2> n,
                                                    OperatorBackend backend)
    {
      if (backend == OperatorBackend::sparse)
        throw InputError(
            "Solver/operator = sparse is not there for variational state-based solids; "
            "choose automatic, fft or direct");
      if (backend == OperatorBackend::automatic)
        backend = DirectSums::estimated_seconds(stencil, n) <
                          Convolution::estimated_seconds(3, stencil.reach(), n)
                      ? OperatorBackend::direct
                      : OperatorBackend::fft;
      if (backend == OperatorBackend::direct)
        return DirectSums(stencil, n);
      return Convolution(stencil, n, 0);
    }
  } // namespace

  std::vector<Neighbour> make_family(const VariationalBody &body, const Kernel<2> &influence,
                                     const Bonds<2> &bonds)
  {
    check(body, bonds);
    std::vector<Neighbour> family;
    for (const Bond<2> &bond : bonds.family)
      family.push_back({{static_cast<int>(std::lround(bond.xi[0] / bonds.h)),
                         static_cast<int>(std::lround(bond.xi[1] / bonds.h))},
                        bond.xi,
                        radial_value(influence, bond) * bond.weight / (bonds.h * bonds.h)});
    return family;
  }

  VariationalOperator::VariationalOperator(VariationalBody body, const Kernel<2> &influence,
                                           const Bonds<2> &bonds, OperatorBackend backend)
      : body_(std::move(body)), family_(make_family(body_, influence, bonds)),
        sums_(make_sums(state_stencil(family_), body_.n, backend)), tau_(body_.size()),
        alpha_(body_.size()), input_(3 * body_.size()), bonds_(3 * body_.size()),
        forces_(3 * body_.size())
  {
    const std::size_t n = body_.size();
    const std::vector<double> &V = body_.V;
    const std::vector<double> m =
        correlate(family_, body_.n, V,
                  [](const Neighbour &other) { return other.weight * other.d.norm_square(); });
    const double whole = *std::max_element(m.begin(), m.end());
    for (std::size_t i = 0; i < n; ++i)
      if (V[i] > 0)
      {
        if (!(m[i] > least_family * whole))
        {
          std::ostringstream message;
          message << "the node (" << body_.node(i)
                  << ") has no neighbours in the body; choose a smaller h or a larger horizon";
          throw NumericalError(message.str());
        }
        tau_[i] = (4 * body_.k[i] - body_.l[i]) / (m[i] * m[i]);
        alpha_[i] = body_.l[i] / m[i];
      }

    for (unsigned int a = 0; a < 2; ++a)
    {
      // the sums of V and α V as fields along axis a
      std::fill(input_.begin(), input_.end(), 0.);
      std::copy(V.begin(), V.end(), input_.begin() + a * n);
      sum(bonds_);
      for (std::size_t i = 0; i < n; ++i)
        input_[a * n + i] *= alpha_[i];
      sum(forces_);
      g_[a].assign(bonds_.begin() + 2 * n, bonds_.end());
      for (unsigned int b = a; b < 2; ++b)
        for (std::size_t i = b * n; i < (b + 1) * n; ++i)
          own_[a + b].push_back(alpha_[i - b * n] * bonds_[i] + forces_[i]);
    }
  }

  void VariationalOperator::sum(std::vector<double> &output) const
  {
    std::visit([&](const auto &sums) { sums.apply(input_.data(), output.data()); }, sums_);
  }

  void VariationalOperator::vmult(Vector &result, const Vector &input) const
  {
    const std::size_t n = body_.size();
    const std::vector<double> &V = body_.V;
    for (std::size_t i = 0; i < n; ++i)
    {
      input_[i] = V[i] * input[i];
      input_[n + i] = V[i] * input[n + i];
      input_[2 * n + i] = 0;
    }
    sum(bonds_);
    for (std::size_t i = 0; i < n; ++i)
    {
      const double T = bonds_[2 * n + i] - g_[0][i] * input[i] - g_[1][i] * input[n + i];
      input_[i] *= alpha_[i];
      input_[n + i] *= alpha_[i];
      input_[2 * n + i] = -tau_[i] * V[i] * T;
    }
    sum(forces_);
    for (std::size_t i = 0; i < n; ++i)
    {
      const double u0 = input[i], u1 = input[n + i], free_V = body_.is_fixed[i] != 0 ? 0 : V[i];
      const double minus_tau_T = V[i] > 0 ? input_[2 * n + i] / V[i] : 0;
      for (unsigned int a = 0; a < 2; ++a)
        result[a * n + i] =
            free_V * (own_[a][i] * u0 + own_[a + 1][i] * u1 - alpha_[i] * bonds_[a * n + i] -
                      forces_[a * n + i] + minus_tau_T * g_[a][i]);
    }
  }

  algebra::SolveResult VariationalOperator::solve(Vector &u, const Vector &f, double tolerance,
                                                  unsigned int max_iterations) const
  {
    return meshfree::solve(*this, u, f, tolerance, max_iterations);
  }

  double VariationalOperator::energy(const Vector &u) const
  {
    const std::size_t n = body_.size();
    const std::vector<double> &V = body_.V;
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      if (V[i] == 0)
        continue;
      const int i1 = static_cast<int>(i % body_.n[0]), i2 = static_cast<int>(i / body_.n[0]);
      double T = 0, bonds = 0;
      for (const auto &[k, d, weight] : family_)
      {
        if (i1 + k[0] < 0 || i1 + k[0] >= body_.n[0] || i2 + k[1] < 0 || i2 + k[1] >= body_.n[1])
          continue;
        const std::size_t j = i + k[1] * static_cast<std::ptrdiff_t>(body_.n[0]) + k[0];
        const double stretch = d[0] * (u[j] - u[i]) + d[1] * (u[n + j] - u[n + i]);
        T += V[j] * weight * stretch;
        bonds += V[j] * weight * stretch * stretch / d.norm_square();
      }
      sum += V[i] * (tau_[i] * T * T + alpha_[i] * bonds);
    }
    return sum;
  }

  std::string VariationalOperator::backend() const
  {
    return std::holds_alternative<DirectSums>(sums_) ? "direct" : "fft";
  }

  std::uint64_t VariationalOperator::n_bonds() const
  {
    const auto n_nodes =
        std::count_if(body_.V.begin(), body_.V.end(), [](double V) { return V > 0; });
    return family_.size() * static_cast<std::uint64_t>(n_nodes);
  }
} // namespace plumbline::meshfree
