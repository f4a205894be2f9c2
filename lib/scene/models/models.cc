#include "scene/models/model.h"

namespace plumbline::scene
{
  const std::vector<const Model *> &models()
  {
    static const std::vector<const Model *> all = {&bond_based(), &lps(), &variational(),
                                                   &double_well()};
    return all;
  }

  std::vector<Capable> capable_models()
  {
    std::vector<Capable> rows;
    for (const Model *const model : models())
      rows.push_back({model->name(), model->can()});
    return rows;
  }
} // namespace plumbline::scene
