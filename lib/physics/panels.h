#pragma once

#include "physics/chebyshev.h"

#include <memory>
#include <mutex>

namespace plumbline::physics
{
  /// A box cut into quarters, and these again, until what a field is made of is smooth on each
  /// panel: a narrow feature in a wide box needs small panels around it alone.
  class Panels
  {
  public:
    struct Panel
    {
      Point<2> lower, upper;
      unsigned int n_terms = 0; ///< along an axis, that resolve the field; 0: it is not smooth
    };
    /// The terms that a panel takes, up to a number of them; 0: more.
    using Terms = std::function<unsigned int(const Point<2> &lower, const Point<2> &upper,
                                             unsigned int most)>;

    /// Panels have a side of 1/64 of the box or more; where nearly none of the panels of 1/4 and
    /// less is smooth, smaller ones are not looked for.
    Panels(const Point<2> &lower, const Point<2> &upper, const Terms &terms);

    const std::vector<Panel> &all() const { return panels_; }
    bool is_one() const { return panels_.size() == 1 && panels_[0].n_terms > 0; }

    /// The number of the panel at x; of the nearest one outside of the box.
    std::size_t index(const Point<2> &x) const;
    const Panel &at(const Point<2> &x) const { return panels_[index(x)]; }

  private:
    static constexpr unsigned int deepest = 6, n_finest = 1u << deepest;

    /// Cut panels of these numbers into quarters. @param rough  overwritten: those not smooth
    void cut(const Terms &terms, std::vector<std::size_t> &rough);

    Point<2> lower_, upper_;
    std::vector<Panel> panels_;
    std::vector<unsigned int> number_; ///< of the panel of each finest square, x fastest
  };

  /// A field that costs much at a point, by series on panels; by itself where there are none. Each
  /// is made when it is first asked for. Threads may share it.
  class PanelField
  {
  public:
    /// @param noise  absolute error of f's own values
    PanelField(ChebyshevField::Function f, unsigned int n_components,
               std::shared_ptr<const Panels> panels, double noise);

    /// To 1e-13 of its largest value on the panel, on a single one 1e-15; empty: f is to be asked.
    const std::optional<ChebyshevField> &series(const Point<2> &x) const;

  private:
    struct Lazy
    {
      std::once_flag once;
      std::optional<ChebyshevField> series;
    };
    std::optional<ChebyshevField> make(const Panels::Panel &panel) const;

    ChebyshevField::Function f_;
    unsigned int n_components_;
    std::shared_ptr<const Panels> panels_;
    double noise_;
    mutable std::mutex mutex_; ///< f may not be shared
    mutable std::vector<Lazy> series_;
  };

  /// The series of a field on the only panel.
  /// @pre panels.is_one()
  std::optional<ChebyshevField> series_on_one(const ChebyshevField::Function &f,
                                              unsigned int n_components, const Panels &panels,
                                              double noise);
} // namespace plumbline::physics
