#include "study/seeds.h"

namespace plumbline::study
{
  std::string seed_words(const scene::RandomSection &random, std::size_t n_samples)
  {
    const std::string seed = "Random/seed = " + std::to_string(random.seed);
    if (random.is_drawn_whole())
      return "The field is drawn whole: " + seed +
             (n_samples > 0 ? ", realisations 1 to " + std::to_string(n_samples) + ", one a sample"
                            : ", Random/realisation = " + std::to_string(random.realisation));
    if (random.field == scene::FieldKind::ellipses)
      return "Modes are found from " + std::to_string(random.n_realisations) +
             " realisations of the field: " + seed;
    return "";
  }
} // namespace plumbline::study
