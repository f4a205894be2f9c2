#include "list.h"

#include "base/choice.h"
#include "base/error.h"
#include "base/similar_words.h"
#include "base/text_file.h"
#include "driver/methods.h"
#include "io/certified_set.h"
#include "physics/kernel.h"
#include "scene/capabilities.h"
#include "scene/models/model.h"
#include "scene/published_names.h"
#include "scene/scene.h"
#include "study/refusal.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <set>

namespace plumbline::app
{
  namespace
  {
    /// What 'plumbline list' lists.
    enum class Listed
    {
      methods,
      models,
      analyses,
      kernels,
      scenes,
      problems
    };
  } // namespace
} // namespace plumbline::app

namespace plumbline::base
{
  template <>
  inline constexpr auto words<app::Listed> =
      std::array{"methods", "models", "analyses", "kernels", "scenes", "problems"};
} // namespace plumbline::base

namespace plumbline::app
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Of a scene, or why it is refused: some are there to be.
    std::string purpose(const fs::path &file)
    {
      try
      {
        return scene::read_scene(file.string()).purpose;
      }
      catch (const InputError &error)
      {
        return std::string("refused: ") + error.what();
      }
    }

    /// Published names of a method.
    std::string also_known_as(const std::string &method)
    {
      std::string text;
      for (const std::string &name : scene::published_names_of(method))
        text += (text.empty() ? "; also known as " : ", ") + name;
      return text;
    }

    void list_methods()
    {
      std::size_t width = 0;
      for (const auto &method : driver::all_methods())
        width = std::max(width, method->name().size() + 1);
      for (const auto &method : driver::all_methods())
        std::cout << std::left << std::setw(static_cast<int>(width)) << method->name()
                  << std::setw(11) << base::word(method->family()) << method->help()
                  << also_known_as(method->name()) << '\n';
    }

    void list_kernels()
    {
      for (const physics::KernelType &type : physics::kernel_types())
        std::cout << std::left << std::setw(24) << type.name << type.formula << "   ("
                  << type.source << ")\n";
    }

    void list_scenes()
    {
      const fs::path folder = io::scenes_folder(io::prefix_of_command());
      if (!fs::is_directory(folder))
        throw InputError("the scenes folder '" + folder.string() + "' is not there");
      std::set<fs::path> files;
      for (const auto &entry : fs::recursive_directory_iterator(folder))
        if (base::has_ending(entry.path().string(), ".prm"))
          files.insert(entry.path());
      for (const fs::path &file : files)
        std::cout << file.string() << "\n    " << purpose(file) << '\n';
    }

    /// Those of the certified set.
    void list_problems()
    {
      for (const std::string &name : io::certified_names(io::prefix_of_command()))
      {
        const study::Certificate certificate = io::certificate_of(name, io::prefix_of_command());
        std::cout << certificate.purpose << "\n    " << certificate.points.size()
                  << " points to at least " << certificate.least_digits() << " digits by "
                  << certificate.galerkin.method << ", confirmed to "
                  << certificate.confirmed_digits() << " by " << certificate.meshfree.method
                  << '\n';
      }
    }
  } // namespace

  bool is_listed(const std::string &subject)
  {
    return base::from_word<Listed>(base::to_lower(subject)).has_value();
  }

  void list(const std::string &subject, bool as_matrix)
  {
    const auto listed = base::from_word<Listed>(base::to_lower(subject));
    if (as_matrix && listed != Listed::methods)
      throw InputError("list --matrix is of methods, not of " + subject + "; leave it out");
    if (as_matrix)
      std::cout << study::capability_table(driver::all_methods());
    else if (listed == Listed::methods)
      list_methods();
    else if (listed == Listed::models)
      std::cout << problem::capability_table(base::word(*listed), scene::capable_models());
    else if (listed == Listed::analyses)
      std::cout << problem::capability_table(base::word(*listed), scene::analyses());
    else if (listed == Listed::kernels)
      list_kernels();
    else if (listed == Listed::scenes)
      list_scenes();
    else if (listed == Listed::problems)
      list_problems();
    else
      throw InputError(
          "list: '" + subject +
          "' is not known; choose methods, models, analyses, kernels, scenes "
          "or problems" +
          base::did_you_mean(subject, {base::words<Listed>.begin(), base::words<Listed>.end()}));
  }
} // namespace plumbline::app
