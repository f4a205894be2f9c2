#pragma once

#include "physics/expression.h"
#include "scene/random_field.h"
#include "uq/sample_points.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace plumbline::scene
{
  class Keys;

  /// A random field of the place, called R in expressions.
  enum class FieldKind
  {
    none,
    exponential, ///< of modes of a covariance, Karhunen and Loève's
    separable,
    gaussian,
    matern,
    ellipses, ///< 1 in ellipses that lie at random, else 0
    files     ///< given, cell by cell
  };

  struct DomainSection;

  /// A number of a scene that is random.
  struct RandomKey
  {
    std::string key, expression; ///< "Section/key", and of variables what it is
  };

  /// What is random in a scene: variables, and a field.
  struct RandomSection
  {
    std::vector<uq::Variable> variables;
    std::vector<RandomKey> random_keys; ///< in the order of the file
    std::vector<double> values;         ///< of all of them; empty: their means
    unsigned int realisation = 1;       ///< of a field that is drawn as a whole

    FieldKind field = FieldKind::none;
    double mean = 0, deviation = 1, smoothness = 1.5; ///< of a field of a covariance
    std::array<double, 2> length = {1, 1};            ///< along x and y [length]
    unsigned int n_modes = 0; ///< each a standard normal variable after the others; 0: drawn whole
    double cell = 0;          ///< of the lattice that a field of modes lives on [length]
    std::vector<geometry::Box> box; ///< that a field fills; empty: that of the domain's boxes
    double fraction = .2;           ///< of the area, in ellipses
    std::array<double, 2> semi_axes = {1, 1}; ///< of ellipses [length]
    bool may_overlap = true;
    unsigned int n_realisations = 1000; ///< that principal components of ellipses are found from
    std::vector<std::string> files;     ///< grids of numbers, named from the scene's folder
    unsigned int seed = 1;

    dealii::Point<2> origin;                   ///< DomainSection's, for expressions
    std::shared_ptr<const RandomField> source; ///< of the field; copies share it
    RandomField::Place place;                  ///< the field at the values, or empty

    bool is_there() const { return !variables.empty() || field != FieldKind::none; }
    /// A realisation a sample, not values of variables.
    bool is_drawn_whole() const { return field != FieldKind::none && n_modes == 0; }
    std::vector<uq::Law> laws() const; ///< of all variables

    /// The values, or the means where there are none.
    std::vector<double> present_values() const;

    /// Its variables at the values, in expressions.
    physics::Names names() const;
    /// "Section/key" and its number, at the values.
    /// @throws InputError  an expression that does not parse or is not finite
    std::vector<std::pair<std::string, double>> key_values() const;

    void declare(Keys &keys);
    /// @param folder  that names of files begin in
    /// @throws InputError  values that are not one for each variable, names that mean something
    /// else, numbers or files that make no field, a field on a mesh whose box is not known
    void complete(const DomainSection &domain, const std::string &folder);

  private:
    void check_variables() const;
  };

  /// What is done with a sample.
  enum class SampledAnalysis
  {
    of_scene, ///< statics, motion, crack, growth or strip, as the scene has it
    stability,
    dispersion
  };

  /// Where a random scene is taken by `plumbline sample`.
  struct SamplingSection
  {
    std::vector<uq::SampleRule> rules; ///< to be compared, the leading one first; empty: none
    SampledAnalysis analysis = SampledAnalysis::of_scene;
    /// Size of each set of samples: points per variable (tensor), level (Smolyak), or number of
    /// samples. One list for each rule, or one for all.
    std::vector<std::vector<unsigned int>> counts;
    /// How many modes of the field vary, few to many, each with every count; empty: all.
    std::vector<unsigned int> modes;
    uq::Growth growth = uq::Growth::odd;
    unsigned int seed = 1;

    bool is_there() const { return !rules.empty(); }
    bool has_several_rules() const { return rules.size() > 1; }
    std::string rule_words() const; ///< as Sampling/rule has them

    /// Of the rule at a place in the list.
    const std::vector<unsigned int> &counts_of(std::size_t rule) const
    {
      return counts[counts.size() == 1 ? 0 : rule];
    }

    /// Nothing is by chance: variables are parameters of a study.
    bool is_axis() const
    {
      return rules.size() == 1 && rules.front() == uq::SampleRule::equidistant;
    }

    void declare(Keys &keys);
  };
} // namespace plumbline::scene

namespace plumbline::base
{
  template <>
  inline constexpr auto words<scene::SampledAnalysis> =
      std::array{"scene", "stability", "dispersion"};
  template <>
  inline constexpr auto words<scene::FieldKind> = std::array{
      "none", "exponential", "separable exponential", "Gaussian", "Matern", "ellipses", "files"};
} // namespace plumbline::base
