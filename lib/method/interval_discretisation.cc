#include "method/interval_discretisation.h"

#include "algebra/banded_system.h"
#include "base/error.h"
#include "base/number_text.h"
#include "base/text_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace plumbline::method
{
  IntervalDiscretisation::IntervalDiscretisation(const problem::Problem<1> &problem,
                                                 std::vector<geometry::AxisSpecies> families,
                                                 algebra::Stencil stencil)
      : lattice_(problem.lattice), families_(std::move(families)), stencil_(std::move(stencil)),
        backend_(problem.settings.solver.operator_backend)
  {
    for (const geometry::AxisSpecies &family : families_)
      for (int i = 0; i < lattice_.n_cells(); ++i)
        is_free_.push_back(lattice_.is_inside(i) &&
                           (!family.at_vertex || lattice_.is_inside(i - 1)));
    if (n_unknowns() == 0)
    {
      std::ostringstream message;
      message << "mesh size h = " << lattice_.h()
              << " leaves no free node in the intervals; refine (Study/h)";
      throw InputError(message.str());
    }
  }

  std::size_t IntervalDiscretisation::n_unknowns() const
  {
    return static_cast<std::size_t>(std::count(is_free_.begin(), is_free_.end(), 1));
  }

  bool IntervalDiscretisation::is_free(unsigned int family, int i) const
  {
    const int n = lattice_.n_cells();
    return i >= 0 && i < n && is_free_[static_cast<std::size_t>(family) * n + i] != 0;
  }

  double IntervalDiscretisation::place(unsigned int family, int i) const
  {
    return lattice_.coordinate(i + families_[family].offset);
  }

  /// Where a node's data are taken: of nodes that a cell owns at its ends, as of discontinuous
  /// elements, inside the cell by more than coordinates are rounded, as data may jump at the end.
  double IntervalDiscretisation::place_of_data(unsigned int family, int i) const
  {
    constexpr double inside = 16 * std::numeric_limits<double>::epsilon();
    const double x = place(family, i), step = inside * std::max(std::abs(x), lattice_.h()),
                 offset = families_[family].offset;
    if (families_[family].at_vertex || (offset > 0 && offset < 1))
      return x;
    return offset == 0 ? x + step : x - step;
  }

  bool IntervalDiscretisation::is_needed(unsigned int family, int i) const
  {
    if (lattice_.is_inside(i) || lattice_.is_inside(i - 1)) // of a cell of Ω
      return true;
    for (unsigned int t = 0; t < families_.size(); ++t)
      for (int k = -stencil_.reach(); k <= stencil_.reach(); ++k)
        if (is_free(t, i + k) && stencil_(t, family, -k, 0) != 0)
          return true;
    return false;
  }

  IntervalDiscretisation::Surroundings
  IntervalDiscretisation::surroundings(const problem::Problem<1> &problem) const
  {
    const int n = lattice_.n_cells(), margin = stencil_.reach() + 1;
    std::vector<char> is_near(static_cast<std::size_t>(n) + 2 * margin);
    for (int last = -2 * margin, i = -margin; i < n + margin; ++i) // cells below
    {
      last = lattice_.is_inside(i) ? i : last;
      is_near[i + margin] = i - last <= margin;
    }
    for (int next = n + 3 * margin, i = n + margin; i-- > -margin;)
    {
      next = lattice_.is_inside(i) ? i : next;
      is_near[i + margin] = is_near[i + margin] != 0 || next - i <= margin;
    }
    Surroundings around{margin, {}, 0};
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::vector<std::size_t> given;
    for (unsigned int s = 0; s < families_.size(); ++s)
      for (int i = -margin; i < n + margin; ++i)
      {
        around.values.push_back(0);
        if (is_free(s, i) || is_near[i + margin] == 0 || !is_needed(s, i))
          continue;
        around.values.back() = problem.constraint.value(dealii::Point<1>(place_of_data(s, i)), 0);
        low = std::min(low, around.values.back());
        high = std::max(high, around.values.back());
        given.push_back(around.values.size() - 1);
      }
    around.middle = low + (high - low) / 2;
    for (const std::size_t i : given)
      around.values[i] -= around.middle;
    return around;
  }

  FieldOnLine IntervalDiscretisation::field(const Vector &u, const Surroundings &around) const
  {
    const int n = lattice_.n_cells();
    const std::size_t width = static_cast<std::size_t>(n) + 2 * around.margin;
    const auto values = std::make_shared<LineValues>();
    values->n = n;
    FieldOnLine result;
    for (unsigned int s = 0; s < families_.size(); ++s)
      for (int i = -1; i <= n; ++i)
      {
        const double value = is_free(s, i) ? u[static_cast<std::size_t>(s) * n + i]
                                           : around.values[s * width + i + around.margin];
        values->values.push_back(value + around.middle);
        if (is_free(s, i))
        {
          result.nodes.push_back(place(s, i));
          result.nodal.push_back(values->values.back());
        }
      }
    lattice_.for_each_cell([&](int cell)
                           { result.averages.push_back(average_over(cell, *values)); });
    result.value = [this, values](double x)
    {
      const auto cell = lattice_.cell_at(x);
      if (!cell)
        throw InputError("the point x = " + std::to_string(x) + " is outside Domain/boxes");
      const double s = (x - lattice_.coordinate(*cell)) / lattice_.h();
      return value_in(*cell, std::clamp(s, 0., 1.), *values);
    };
    return result;
  }

  IntervalDiscretisation::Data
  IntervalDiscretisation::data(const problem::Problem<1> &problem) const
  {
    const Surroundings around = surroundings(problem);
    const int n = lattice_.n_cells(), reach = stencil_.reach();
    const std::size_t width = static_cast<std::size_t>(n) + 2 * around.margin;
    std::vector<double> within; // reach alone
    for (unsigned int s = 0; s < families_.size(); ++s)
    {
      const auto first =
          around.values.begin() + static_cast<std::ptrdiff_t>(s * width + around.margin - reach);
      within.insert(within.end(), first, first + n + 2 * reach);
    }
    Data result;
    result.load = load(problem);
    result.load -= algebra::line_action(stencil_, n, is_free_, within);
    result.field = [this, around](const Vector &u) { return field(u, around); };
    return result;
  }

  std::unique_ptr<algebra::LinearSystem> IntervalDiscretisation::tangent() const
  {
    const int n = lattice_.n_cells();
    using Backend = algebra::OperatorBackend;
    if (families_.size() == 1)
      return std::make_unique<algebra::StencilSystem>(
          stencil_, geometry::BoxNodes{{n, 1, 1}, is_free_}, backend_);
    if (backend_ != Backend::automatic && backend_ != Backend::direct)
      throw InputError("Solver/operator = " + base::word(backend_) +
                       " does not support methods with several unknowns per cell, whose matrix "
                       "is factored; write automatic or direct");
    return std::make_unique<algebra::BandedSystem>(stencil_, n, is_free_);
  }

  void write_csv(const FieldOnLine &field, const std::string &file)
  {
    constexpr int n_digits = 17;
    std::vector<std::pair<double, double>> rows;
    for (std::size_t i = 0; i < field.nodes.size(); ++i)
      rows.emplace_back(field.nodes[i], field.nodal[i]);
    std::sort(rows.begin(), rows.end());
    std::string text = "x,u\n";
    for (const auto &[x, u] : rows)
      text += base::to_text(x, n_digits) + "," + base::to_text(u, n_digits) + "\n";
    base::write_file(file, text);
  }
} // namespace plumbline::method
