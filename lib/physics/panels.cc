#include "physics/panels.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace plumbline::physics
{
  namespace
  {
    constexpr unsigned int most_of_all = 129, most_of_a_part = 33; ///< terms along an axis

    /// Where a search begins, of 9, 17, 33 ...: an operator smooths, and a part takes less than its
    /// surroundings, so with half of the terms that those take.
    unsigned int first_points(unsigned int n_terms)
    {
      unsigned int n = 9;
      while (n < n_terms / 2 + 2 && n < most_of_all)
        n = 2 * n - 1;
      return n;
    }
    /// f is as smooth as what it is made of, which was looked at closely: few control points do.
    std::optional<ChebyshevField> series_of(const ChebyshevField::Function &f,
                                            unsigned int n_components, const Panels::Panel &panel,
                                            const ChebyshevField::Search &search, double noise)
    try
    {
      return ChebyshevField::resolve(f, n_components, panel.lower, panel.upper, noise, search);
    }
    catch (const std::runtime_error &) // comes again where f itself is asked for
    {
      return {};
    }
  } // namespace

  Panels::Panels(const Point<2> &lower, const Point<2> &upper, const Terms &terms)
      : lower_(lower), upper_(upper), panels_{{lower, upper, terms(lower, upper, most_of_all)}}
  {
    constexpr double hopeless = .75; // of the panels of one size
    std::vector<std::size_t> rough;
    if (panels_[0].n_terms == 0)
      rough.push_back(0);
    for (unsigned int depth = 1; depth <= deepest && !rough.empty(); ++depth)
    {
      const double n_panels = std::ldexp(1, 2 * static_cast<int>(depth));
      cut(terms, rough);
      if (depth > 1 && static_cast<double>(rough.size()) > hopeless * n_panels)
        break;
    }
    number_.resize(n_finest * n_finest);
    for (std::size_t k = 0; k < panels_.size(); ++k)
    {
      std::array<std::array<unsigned int, 2>, 2> range{};
      for (unsigned int axis = 0; axis < 2; ++axis)
        for (unsigned int end = 0; end < 2; ++end)
        {
          const double x = end == 0 ? panels_[k].lower[axis] : panels_[k].upper[axis];
          range[axis][end] = static_cast<unsigned int>(
              std::lround(n_finest * (x - lower_[axis]) / (upper_[axis] - lower_[axis])));
        }
      for (unsigned int j = range[1][0]; j < range[1][1]; ++j)
        for (unsigned int i = range[0][0]; i < range[0][1]; ++i)
          number_[j * n_finest + i] = static_cast<unsigned int>(k);
    }
  }

  void Panels::cut(const Terms &terms, std::vector<std::size_t> &rough)
  {
    std::vector<std::size_t> still;
    for (const std::size_t number : rough)
    {
      const Panel whole = panels_[number];
      const Point<2> middle = whole.lower + .5 * (whole.upper - whole.lower);
      for (unsigned int quarter = 0; quarter < 4; ++quarter)
      {
        Panel part;
        for (unsigned int axis = 0; axis < 2; ++axis)
        {
          const bool is_upper = (quarter >> axis & 1) != 0;
          part.lower[axis] = is_upper ? middle[axis] : whole.lower[axis];
          part.upper[axis] = is_upper ? whole.upper[axis] : middle[axis];
        }
        part.n_terms = terms(part.lower, part.upper, most_of_a_part);
        const std::size_t place = quarter == 0 ? number : panels_.size();
        if (quarter == 0)
          panels_[number] = part;
        else
          panels_.push_back(part);
        if (part.n_terms == 0)
          still.push_back(place);
      }
    }
    rough = std::move(still);
  }

  std::size_t Panels::index(const Point<2> &x) const
  {
    std::array<std::size_t, 2> k{};
    for (unsigned int axis = 0; axis < 2; ++axis)
    {
      const double s = (x[axis] - lower_[axis]) / (upper_[axis] - lower_[axis]);
      k[axis] = static_cast<std::size_t>(std::clamp(n_finest * s, 0., n_finest - 1.));
    }
    return number_[k[1] * n_finest + k[0]];
  }

  PanelField::PanelField(ChebyshevField::Function f, unsigned int n_components,
                         std::shared_ptr<const Panels> panels, double noise)
      : f_(std::move(f)), n_components_(n_components), panels_(std::move(panels)), noise_(noise),
        series_(panels_->all().size())
  {
  }

  const std::optional<ChebyshevField> &PanelField::series(const Point<2> &x) const
  {
    const std::size_t k = panels_->index(x);
    Lazy &lazy = series_[k];
    std::call_once(lazy.once,
                   [&]
                   {
                     const std::lock_guard<std::mutex> alone(mutex_);
                     lazy.series = make(panels_->all()[k]);
                   });
    return lazy.series;
  }

  std::optional<ChebyshevField> PanelField::make(const Panels::Panel &panel) const
  {
    const double digits = panels_->is_one() ? 1e-15 : 1e-13;
    if (panel.n_terms == 0)
      return {};
    return series_of(f_, n_components_, panel,
                     {{2, 2}, first_points(panel.n_terms), most_of_all, digits}, noise_);
  }

  std::optional<ChebyshevField> series_on_one(const ChebyshevField::Function &f,
                                              unsigned int n_components, const Panels &panels,
                                              double noise)
  {
    const Panels::Panel &panel = panels.all().front();
    return series_of(f, n_components, panel, {{4, 4}, first_points(panel.n_terms), most_of_all},
                     noise);
  }
} // namespace plumbline::physics
