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
  /// A scene file, parsed and checked.
  struct Scene
  {
    std::string name, purpose;
    /// All keys and values, and, as comments, hashes of the files that it names: scenes with equal
    /// texts are equal. Parses to the same scene.
    std::string text;
    std::string folder; ///< of the scene's file: other file names are relative to it

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
    bool is_vector() const; ///< u has one component for each axis
    unsigned int n_components() const { return is_vector() ? domain.dimension : 1; }

    /// Transient or with crack analyses: not a sequence of static problems.
    bool is_no_problem() const
    {
      return time.is_dynamic() || crack.is_there() || fracture.is_there() || strip.is_there();
    }

    /// The forces depend on the dilatation, see Model::has_dilatation.
    bool has_dilatation() const;

    /// Names in expressions of this scene: delta, t in transient analyses, random variables and
    /// field.
    physics::Names names(double horizon, double t = 0) const;

    /// No expression depends on t.
    bool is_steady() const;

    /// Width of the interaction domain around Ω: the horizon, or twice the horizon if forces depend
    /// on the dilatations of neighbours.
    double reach(double horizon) const { return has_dilatation() ? 2 * horizon : horizon; }
  };

  /// The kernel of its bonds; for double wells, linearised at zero strain.
  physics::Kernel<2> make_kernel(const Scene &scene, double horizon);

  /// The same in space.
  /// @throws InputError  a model of the plane
  physics::Kernel<3> make_kernel_in_space(const Scene &scene, double horizon);

  /// The double-well potential of its bonds.
  /// @throws InputError  a constant or an influence function (Kernel/type) that is not allowed
  /// @pre scene.material.model == &double_well()
  physics::DoubleWell make_double_well(const Scene &scene, double horizon);

  /// The same scene at other values of its random variables; whether its material is valid there is
  /// checked when it is needed.
  /// @param values       of all of them, see RandomSection
  /// @param realisation  of a field without modes
  Scene at_sample(Scene scene, const std::vector<double> &values, unsigned int realisation);

  /// The same scene at a level of its study, with Study/variable at the level's value.
  /// @throws InputError  naming Study/values if the scene is not valid at this value
  Scene at_level(const Scene &scene, const Level &level);

  /// The same scene with Solver/model = full, to verify the smallest model.
  Scene full_model(Scene scene);

  /// Section/key = value, given on the command line after the file was read.
  struct Override
  {
    std::string key, value;
  };

  /// Whether a scene's file is a pipe or a terminal ('cat SCENE | plumbline run /dev/stdin'), which
  /// can be read once.
  bool is_read_once(const std::string &file);

  /// @param file  .prm or .json; from a pipe, either of them; the scene is then called 'stdin' and
  /// file names are relative to the working directory
  /// @throws InputError  file not readable, unknown key, wrong type, or inconsistent values
  Scene read_scene(const std::string &file, const std::vector<Override> &overrides = {});

  /// The same from a text in .prm syntax.
  Scene parse_scene(const std::string &name, const std::string &text,
                    const std::vector<Override> &overrides = {});

  /// A whole scene with every key, its default and its meaning, for a model: "scalar", "tensor",
  /// "LPS", "variational" or "double-well".
  std::string scene_template(const std::string &model);

  /// A scene of a few lines for the same models, with the keys that differ from the defaults, mesh
  /// sizes and horizons.
  /// @param changes  in place of its values, or more keys
  std::string short_template(const std::string &model, const std::vector<Override> &changes = {});

  /// Meaning, default and allowed values of a key; for "Section", of all its keys; for other words,
  /// of the keys whose names and meanings have them, names first.
  /// @throws InputError  no such key, nor any with these words; the message names similar ones
  std::string describe(const std::string &key);
} // namespace plumbline::scene
