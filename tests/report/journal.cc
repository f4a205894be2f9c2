// What is finished while a run goes on.
#include "report/journal.h"

#include "base/error.h"
#include "fixture.h"
#include "report/json.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    namespace fs = std::filesystem;

    /// As it was after so many solves.
    study::Results after(std::size_t n, study::Results results)
    {
      results.runs.resize(n);
      results.references.resize(std::min(n / 2, results.references.size()));
      results.maps.resize(n / 3);
      return results;
    }

    study::Results whole()
    {
      study::Results results = fixture::results();
      results.trends.clear();
      results.advice.clear();
      results.expectations.clear();
      results.omissions.clear();
      results.scene_text = std::string(10000, '#');
      return after(6, results);
    }

    std::size_t n_lines(const fs::path &file)
    {
      const std::string text = fixture::read(file);
      return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }
  } // namespace

  TEST(Journal, holds_what_came_a_line_for_each_call)
  {
    const fixture::Folder folder;
    const fs::path file = folder.path() / "results.jsonl";
    Journal journal(folder.path());
    std::uintmax_t first = 0, before = 0;
    for (std::size_t n = 1; n <= 6; ++n)
    {
      journal.append(after(n, whole()));
      EXPECT_EQ(n_lines(file), n);
      EXPECT_EQ(to_json(read_results(folder.path())), to_json(after(n, whole())));
      const auto size = fs::file_size(file);
      first = n == 1 ? size : first;
      if (n > 1)
      {
        EXPECT_LT(size - before, first - 9000) << "the scene again";
      }
      before = size;
    }
    EXPECT_EQ(results_file(folder.path()), file);
    journal.remove();
    EXPECT_EQ(results_file(folder.path()), folder.path() / "results.json");
  }

  TEST(Journal, a_line_that_was_cut_off_does_not_count_and_a_broken_one_is_named)
  {
    const fixture::Folder folder;
    const fs::path file = folder.path() / "results.jsonl";
    Journal journal(folder.path());
    for (std::size_t n = 1; n <= 3; ++n)
      journal.append(after(n, whole()));
    const std::string text = fixture::read(file);
    const std::size_t second = text.find('\n') + 1, third = text.find('\n', second) + 1;
    for (const std::size_t size : {text.size() - 1, text.size() - 40, third + 1, third})
    {
      std::ofstream(file) << text.substr(0, size);
      EXPECT_EQ(to_json(read_results(folder.path())), to_json(after(2, whole()))) << size;
    }
    std::ofstream(file) << text.substr(0, second) << "{\"runs\": 3\n" << text.substr(third);
    EXPECT_THROW(read_results(folder.path()), InputError);
  }

  TEST(Journal, of_another_run_is_replaced_by_the_first_line)
  {
    const fixture::Folder folder;
    Journal killed(folder.path());
    killed.append(after(2, whole()));
    killed.append(after(4, whole()));
    Journal journal(folder.path());
    EXPECT_EQ(read_results(folder.path()).runs.size(), 4u);
    journal.append(after(5, whole()));
    EXPECT_EQ(to_json(read_results(folder.path())), to_json(after(5, whole())));
  }

  TEST(Journal, that_cannot_be_written_is_an_error)
  {
    const fixture::Folder folder;
    fs::create_symlink("/dev/full", folder.path() / "results.jsonl.part");
    Journal journal(folder.path());
    EXPECT_THROW(journal.append(whole()), InputError);
    fs::remove(folder.path() / "results.jsonl.part");
    journal.append(after(1, whole()));
    fs::remove(folder.path() / "results.jsonl");
    fs::create_symlink("/dev/full", folder.path() / "results.jsonl");
    EXPECT_THROW(journal.append(after(2, whole())), InputError);
  }
} // namespace plumbline::report
