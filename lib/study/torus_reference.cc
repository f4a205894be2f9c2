#include "study/torus_reference.h"

#include "study/motion_estimate.h"
#include "study/motion_norms.h"

#include <utility>

namespace plumbline::study
{
  using analysis::Transient;

  std::vector<double> Torus::at(const std::vector<dealii::Point<2>> &nodes,
                                const std::vector<double> &of) const
  {
    std::vector<double> values;
    for (const auto &node : nodes)
      for (unsigned int c = 0; c < equation->n_components(); ++c)
        values.push_back(equation->value(of, node, c));
    return values;
  }

  TorusSolution solve_torus(const scene::Scene &scene, const MotionControl &control,
                            const std::string &problem, double horizon, ProblemsInTime &problems)
  {
    constexpr double tolerance = 1e-8;
    const base::CpuTimer timer;
    Torus coarse, fine;
    TorusEstimate estimate{problem, horizon};
    using Sizes = std::vector<unsigned int>;
    for (const unsigned int n :
         scene.domain.dimension == 1 ? Sizes{32, 48, 72, 108, 162} : Sizes{16, 24, 36, 54})
    {
      coarse = std::move(fine);
      fine.equation = control.make_torus(scene, horizon, n);
      const MotionData data = motion_data(scene, *fine.equation, problems);
      const Transient transient(*fine.equation, data.drive, scene.time.density, scene.time.damping);
      fine.state = move_exactly(scene, transient, data.start);
      estimate.n_points = n;
      if (!coarse.equation)
        continue;
      const std::vector<double> exact = fine.at(coarse.equation->nodes(), fine.state.u);
      const unsigned int n_components = fine.equation->n_components();
      estimate.estimate = norm_of(difference(coarse.equation->nodal(coarse.state.u), exact),
                                  n_components, 1, false);
      if (estimate.estimate <= tolerance * extent_of(exact, n_components))
        break;
    }
    estimate.seconds = timer.seconds();
    return {fine, estimate};
  }
} // namespace plumbline::study
