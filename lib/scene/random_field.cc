#include "scene/random_field.h"

#include "base/error.h"
#include "scene/pictures.h"
#include "scene/random_section.h"
#include "scene/values.h"
#include "uq/karhunen_loeve.h"
#include "uq/principal_components.h"

#include <algorithm>
#include <mutex>

namespace plumbline::scene
{
  using dealii::Point;
  using geometry::Box;

  namespace
  {
    uq::Covariance covariance_of(const RandomSection &section)
    {
      const auto shape = static_cast<uq::CovarianceShape>(static_cast<int>(section.field) -
                                                          static_cast<int>(FieldKind::exponential));
      return {shape, section.deviation * section.deviation, section.length, section.smoothness};
    }

    uq::EllipseModel ellipses_of(const RandomSection &section)
    {
      return {section.semi_axes, section.fraction, section.may_overlap};
    }

    /// In a box: what lies beyond it is moved to its side.
    Point<2> into(const Box &box, const Point<2> &x)
    {
      return {std::clamp(x[0], box.lower[0], box.upper[0]),
              std::clamp(x[1], box.lower[1], box.upper[1])};
    }
  } // namespace

  struct RandomField::Shared
  {
    RandomSection section;
    Box box;
    std::vector<uq::GridField> pictures; ///< of files
    std::once_flag once;
    std::optional<uq::Expansion> expansion;

    uq::Ellipses draw(std::size_t realisation) const
    {
      return uq::Ellipses::draw(ellipses_of(section), box, section.seed, realisation);
    }

    /// What is in ellipses at the nodes of a grid.
    void draw(std::size_t realisation, const uq::Grid &grid, std::vector<double> &values) const
    {
      const uq::Ellipses ellipses = draw(realisation);
      values.clear();
      for (int j = 0; j < grid.n[1]; ++j)
        for (int i = 0; i < grid.n[0]; ++i)
          values.push_back(ellipses.covers(grid.node(i, j)) ? 1 : 0);
    }

    /// That modes are found on.
    uq::Grid grid() const
    {
      return pictures.empty() ? uq::make_grid(box, section.cell) : pictures.front().grid();
    }

    uq::Expansion components_of_ellipses() const
    {
      const uq::Grid grid = this->grid();
      return uq::principal_components(
                 grid, section.n_realisations,
                 [&](std::size_t k, std::vector<double> &values) // that no sample takes
                 { draw((std::size_t{1} << 32) + k, grid, values); },
                 section.n_modes)
          .expansion;
    }

    uq::Expansion components_of_files() const
    {
      // to more digits than realisations that must be drawn anew: passes through these are cheap
      constexpr uq::PassLimit limit{100, 1e-10};
      return uq::principal_components(
                 grid(), pictures.size(),
                 [&](std::size_t k, std::vector<double> &values) { values = pictures[k].values(); },
                 section.n_modes, limit)
          .expansion;
    }

    const uq::Expansion &find_expansion()
    {
      std::call_once(once,
                     [this]
                     {
                       if (section.field == FieldKind::ellipses)
                         expansion = components_of_ellipses();
                       else if (section.field == FieldKind::files)
                         expansion = components_of_files();
                       else
                         expansion = uq::karhunen_loeve(covariance_of(section), grid(),
                                                        section.n_modes, section.mean);
                     });
      return *expansion;
    }

    /// Of files and their modes it is constant in each cell.
    uq::Interpolation between() const
    {
      return pictures.empty() ? uq::Interpolation::linear : uq::Interpolation::constant;
    }
  };

  RandomField::RandomField(const RandomSection &section, const Box &box, const std::string &folder)
      : shared_(std::make_shared<Shared>())
  {
    shared_->section = section;
    shared_->section.source.reset(); // no circle
    shared_->section.place = {};
    shared_->box = box;
    const auto saying = [](const std::string &key, const auto &check)
    {
      try
      {
        check();
      }
      catch (const InputError &error)
      {
        throw InputError(key + error.what());
      }
    };
    const std::string field = "Random/field = " + base::word(section.field);
    if (section.field == FieldKind::files)
    {
      std::vector<uq::GridField> &pictures = shared_->pictures;
      saying("Random/files: ", [&] { pictures = read_pictures(section.files, folder, box); });
      const std::size_t n_cells = shared_->grid().size(),
                        most = std::min(pictures.size() - 1, n_cells);
      require(section.n_modes <= most,
              "Random/modes = " + std::to_string(section.n_modes) + ", but Random/files (" +
                  std::to_string(pictures.size()) + ", of " + std::to_string(n_cells) +
                  " cells each) have " + std::to_string(most) +
                  " principal components; write no more, 0 to draw them whole, or give more files");
      return;
    }
    if (section.field == FieldKind::ellipses)
    {
      if (section.fraction < 1)
        saying("Random/fraction, semi-axes: ", [&] { check(ellipses_of(section)); });
      else // all is covered
        require(section.n_modes == 0, "Random/fraction = " + short_number(section.fraction) +
                                          " is the same everywhere, which has no modes; write "
                                          "Random/modes = 0");
    }
    else
    {
      saying("Random/deviation, length, smoothness: ", [&] { check(covariance_of(section)); });
      require(section.n_modes > 0, field + " needs Random/modes > 0, of how many it is made");
    }
    require(section.n_modes == 0 || section.cell > 0,
            field + " with modes needs Random/cell > 0, the mesh size that modes are found on");
    if (section.n_modes > 0)
    {
      const uq::Grid grid = uq::make_grid(box, section.cell);
      require(section.n_modes <= grid.size(),
              "Random/modes = " + std::to_string(section.n_modes) + ", but Random/cell = " +
                  short_number(section.cell) + " makes " + std::to_string(grid.size()) +
                  " cells, which have no more modes; take fewer, or a smaller cell");
    }
  }

  RandomField::Place RandomField::at(const std::vector<double> &modes,
                                     unsigned int realisation) const
  {
    const RandomSection &section = shared_->section;
    if (section.n_modes > 0)
    {
      struct Lazy
      {
        std::once_flag once;
        uq::GridField field;
      };
      return [shared = shared_, lazy = std::make_shared<Lazy>(), modes](const Point<2> &x)
      {
        std::call_once(
            lazy->once,
            [&] { lazy->field = shared->find_expansion().realise(modes, shared->between()); });
        return lazy->field(x);
      };
    }
    if (const std::size_t n = shared_->pictures.size(); n > 0)
      return [shared = shared_, k = (realisation + n - 1) % n](const Point<2> &x)
      { return shared->pictures[k](x); };
    if (section.fraction >= 1)
      return [](const Point<2> &) { return 1.; };
    struct Lazy
    {
      std::once_flag once;
      std::optional<uq::Ellipses> ellipses;
    };
    return [shared = shared_, lazy = std::make_shared<Lazy>(), realisation](const Point<2> &x)
    {
      std::call_once(lazy->once, [&] { lazy->ellipses = shared->draw(realisation); });
      return lazy->ellipses->covers(into(shared->box, x)) ? 1. : 0.;
    };
  }

  const uq::Expansion *RandomField::expansion() const
  {
    return shared_->section.n_modes > 0 ? &shared_->find_expansion() : nullptr;
  }
} // namespace plumbline::scene
