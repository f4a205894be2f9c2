#include "app/new.h"

#include "base/error.h"
#include "driver/analyses.h"
#include "driver/methods.h"
#include "scene/scene.h"
#include "study/method_names.h"
#include "study/preflight.h"

#include <filesystem>

namespace plumbline::app
{
  namespace
  {
    /// @throws InputError  the command does not take the scene's methods
    void check_methods(const scene::NewScene &written)
    {
      const scene::Scene scene =
          study::with_names_of(scene::read_scene(written.file), driver::all_methods());
      if (const driver::AnalysisRow *const row = driver::find_analysis(written.command))
        (void)row->make({{}}).choose_methods(scene, driver::all_methods(), 0, 1);
      else
        (void)study::choose_methods(scene, driver::all_methods());
    }
  } // namespace

  std::string write_scene(const scene::NewSceneOptions &options)
  {
    const scene::NewScene written = scene::write_new_scene(options);
    try
    {
      check_methods(written);
    }
    catch (const InputError &error)
    {
      std::filesystem::remove(written.file);
      if (!written.table.empty())
        std::filesystem::remove(written.table);
      throw InputError(std::string("no scene is written: ") + error.what());
    }
    return "written: " + written.file +
           (written.table.empty()
                ? ""
                : " and " + written.table + " (t = r / horizon and rho: put your profile there)") +
           (written.note.empty() ? "" : "; " + written.note) + "; next: plumbline " +
           written.command + ' ' + written.file + '\n';
  }
} // namespace plumbline::app
