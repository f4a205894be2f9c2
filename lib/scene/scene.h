#pragma once

#include "physics/double_well.h"
#include "scene/crack_section.h"
#include "scene/fracture_section.h"
#include "scene/problem_sections.h"
#include "scene/random_section.h"
#include "scene/strip_section.h"
#include "scene/study_sections.h"
#include "scene/time_section.h"

namespace plumbline::scene
{
  /// Everything a scene file says, checked.
  struct Scene
  {
    std::string name, purpose;
    /// All keys and values, and hashes of the files that it names in comments: two scenes with the
    /// same text are the same. Parses to the same scene.
    std::string text;
    std::string folder; ///< of the scene's file: other files are named from there

    DomainSection domain;
    RandomSection random;
    KernelSection kernel;
    MaterialSection material;
    ProblemSection problem;
    MethodsSection methods;
    StudySection study;
    SamplingSection sampling;
    TimeSection time;
    CrackSection crack;
    FractureSection fracture;
    StripSection strip;
    ReferenceSection reference;
    QuadratureSection quadrature;
    GeometrySection geometry;
    SolverSection solver;
    OutputSection output;
    ExpectedSection expected;

    bool is_homogeneous() const
    {
      return kernel.coefficient.empty() && kernel.materials.empty() && material.is_homogeneous;
    }
    bool is_vector() const; ///< a component for each axis
    unsigned int n_components() const { return is_vector() ? domain.dimension : 1; }

    /// It moves, or has cracks that do or stand in a strip: not one problem at a time.
    bool is_no_problem() const
    {
      return time.is_dynamic() || crack.is_there() || fracture.is_there() || strip.is_there();
    }

    /// Its model's force is more than bonds, see Model::has_dilatation.
    bool has_dilatation() const;

    /// Names in expressions of this scene: delta, t where it moves, and what is random.
    physics::Names names(double horizon, double t = 0) const;

    /// No expression has t in it.
    bool is_steady() const;

    /// How far from Ω the constraint is needed: the horizon, or twice as far where dilatations of
    /// neighbours count.
    double reach(double horizon) const { return has_dilatation() ? 2 * horizon : horizon; }
  };

  /// The kernel of its bonds; of double wells those of small strains.
  physics::Kernel<2> make_kernel(const Scene &scene, double horizon);

  /// The law of its bonds with two wells.
  /// @throws InputError  a constant or an influence function (Kernel/type) that is not allowed
  /// @pre scene.material.model == &double_well()
  physics::DoubleWell make_double_well(const Scene &scene, double horizon);

  /// The same scene at other values of its random variables; whether its material is one there is
  /// seen when it is needed.
  /// @param values       of all of them, see RandomSection
  /// @param realisation  of a field that is drawn as a whole
  Scene at_sample(Scene scene, const std::vector<double> &values, unsigned int realisation);

  /// The same scene at a level of its study, where that varies a number of it.
  /// @throws InputError  the number does not fit the scene, naming Study/values
  Scene at_level(const Scene &scene, const Level &level);

  /// The same scene with nothing left out, to show that what is left out is not missed.
  Scene full_model(Scene scene);

  /// Section/key = value, given on the command line after the file was read.
  struct Override
  {
    std::string key, value;
  };

  /// Whether a scene's file is a pipe or a terminal ('cat SCENE | plumbline run /dev/stdin'): its
  /// text is there once.
  bool is_read_once(const std::string &file);

  /// @param file  .prm or .json; from a pipe either, whose scene is called 'stdin' and names other
  /// files from the working directory
  /// @throws InputError  file not readable, unknown key, wrong type, or values that do not fit
  /// together
  Scene read_scene(const std::string &file, const std::vector<Override> &overrides = {});

  /// The same from a text in .prm syntax.
  Scene parse_scene(const std::string &name, const std::string &text,
                    const std::vector<Override> &overrides = {});

  /// A whole scene with every key, its default and its meaning, for a model: "scalar", "tensor",
  /// "LPS", "variational" or "double-well".
  std::string scene_template(const std::string &model);

  /// What a key means, its default and what it allows; for "Section" all its keys.
  /// @throws InputError  unknown key; the message names similar ones
  std::string describe(const std::string &key);
} // namespace plumbline::scene
