// What is finished while a run goes on.
#include "io/record_journal.h"

#include "base/error.h"
#include "io/results_json.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumbline::io
{
  namespace fixture = report::fixture;

  namespace
  {
    namespace fs = std::filesystem;

    /// As it was after so many solves.
    study::StudyResults after(std::size_t n, study::StudyResults results)
    {
      results.records.resize(n);
      results.references.resize(std::min(n / 2, results.references.size()));
      results.maps.resize(n / 3);
      return results;
    }

    study::StudyResults whole()
    {
      study::StudyResults results = fixture::results();
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

  TEST(StaticsJournal, holds_what_came_with_each_call)
  {
    const fixture::Folder folder;
    const fs::path file = folder.path() / "results.jsonl";
    RecordJournal journal(folder.path() / "results.jsonl", "scene");
    std::uintmax_t first = 0, before = 0;
    std::size_t n_statements = 1;
    for (std::size_t n = 1; n <= 6; ++n)
    {
      journal.append(after(n, whole()));
      n_statements += n == 2 || n == 3 || n == 4 || n == 6 ? 1 : 0; // with references or maps
      EXPECT_EQ(n_lines(file), 1 + n_statements + n);
      EXPECT_EQ(to_json(results_in(folder.path())), to_json(after(n, whole())));
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

  TEST(StaticsJournal, a_line_that_was_cut_off_does_not_count_and_a_broken_one_is_named)
  {
    const fixture::Folder folder;
    const fs::path file = folder.path() / "results.jsonl";
    RecordJournal journal(folder.path() / "results.jsonl", "scene");
    for (std::size_t n = 1; n <= 3; ++n)
      journal.append(after(n, whole()));
    const std::string text = fixture::read(file);
    const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
    for (const std::size_t size : {text.size() - 1, text.size() - 40, last + 1, last})
    {
      std::ofstream(file) << text.substr(0, size);
      study::StudyResults expected = after(3, whole()); // a record came last
      expected.records.resize(2);
      EXPECT_EQ(to_json(results_in(folder.path())), to_json(expected)) << size;
    }
    const std::size_t second = text.find('\n') + 1;
    std::ofstream(file) << text.substr(0, second) << "{\"records\": 3}\n" << text.substr(second);
    EXPECT_THROW(results_in(folder.path()), InputError);
    std::ofstream(file) << text.substr(second);
    EXPECT_THROW(results_in(folder.path()), InputError) << "without a head";
  }

  TEST(StaticsJournal, of_another_run_is_replaced_by_the_first_line)
  {
    const fixture::Folder folder;
    RecordJournal killed(folder.path() / "results.jsonl", "scene");
    killed.append(after(2, whole()));
    killed.append(after(4, whole()));
    RecordJournal journal(folder.path() / "results.jsonl", "scene");
    EXPECT_EQ(results_in(folder.path()).records.size(), 4u);
    journal.append(after(5, whole()));
    EXPECT_EQ(to_json(results_in(folder.path())), to_json(after(5, whole())));
  }

  TEST(StaticsJournal, that_cannot_be_written_is_an_error)
  {
    const fixture::Folder folder;
    fs::create_symlink("/dev/full", folder.path() / "results.jsonl.part");
    RecordJournal journal(folder.path() / "results.jsonl", "scene");
    EXPECT_THROW(journal.append(whole()), InputError);
    fs::remove(folder.path() / "results.jsonl.part");
    journal.append(after(1, whole()));
    fs::remove(folder.path() / "results.jsonl");
    fs::create_symlink("/dev/full", folder.path() / "results.jsonl");
    EXPECT_THROW(journal.append(after(2, whole())), InputError);
  }
} // namespace plumbline::io
