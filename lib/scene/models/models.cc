#include "scene/models/model.h"

#include "base/error.h"

namespace plumbline::scene
{
  const std::vector<const Model *> &models()
  {
    static const std::vector<const Model *> all = {&bond_based(), &lps(), &variational(),
                                                   &double_well()};
    return all;
  }

  physics::Kernel<3> Model::kernel_in_space(const Scene &, double) const
  {
    throw InputError("Material/model = " + name() +
                     " is for the plane; write Domain/dimension = 2, or Material/model = " +
                     bond_based().name());
  }

  std::vector<Capable> capable_models(bool is_in_space)
  {
    std::vector<Capable> rows;
    for (const Model *const model : models())
      rows.push_back({model->name(), is_in_space ? model->can_in_space() : model->can()});
    return rows;
  }
} // namespace plumbline::scene
