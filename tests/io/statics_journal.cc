// What is finished while a run goes on.
#include "io/record_journal.h"

#include "base/error.h"
#include "io/results_json.h"
#include "study/statement_lists.h"
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
      results.left_out.clear();
      results.scene_text = std::string(10000, '#');
      return after(6, results);
    }

    /// What came with one more solve.
    study::StudyResults made(std::size_t n)
    {
      study::StudyResults results = after(n, whole());
      const study::StudyResults before = after(n - 1, whole());
      const auto erase = [&](auto list)
      {
        auto &all = results.*list;
        all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>((before.*list).size()));
      };
      erase(&study::StudyResults::records);
      study::for_each_statement_list(erase);
      return results;
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
    for (std::size_t n = 1; n <= 6; ++n)
    {
      journal.append(n == 1 ? after(n, whole()) : made(n));
      EXPECT_EQ(n_lines(file), 1 + n);
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
      journal.append(n == 1 ? after(n, whole()) : made(n));
    const std::string text = fixture::read(file);
    const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
    for (const std::size_t size : {text.size() - 1, text.size() - 40, last + 1, last})
    {
      std::ofstream(file) << text.substr(0, size);
      EXPECT_EQ(to_json(results_in(folder.path())), to_json(after(2, whole()))) << size;
    }
    const std::size_t second = text.find('\n') + 1;
    std::ofstream(file) << text.substr(0, second) << "{\"records\": 3}\n" << text.substr(second);
    EXPECT_THROW(results_in(folder.path()), InputError);
    std::ofstream(file) << text.substr(second);
    EXPECT_THROW(results_in(folder.path()), InputError) << "without a head";
  }

  // Statements of places that the next study has not come to yet are kept, too.
  TEST(StaticsJournal, goes_on_after_each_kill)
  {
    const fixture::Folder folder;
    const fs::path file = folder.path() / "results.jsonl";
    RecordJournal(file, "scene").append(after(4, whole()));
    for (std::size_t n = 5; n <= 6; ++n)
    {
      RecordJournal next(file, "scene");
      EXPECT_EQ(to_json(next.earlier()), to_json(after(n - 1, whole())));
      next.append(made(n));
      EXPECT_EQ(to_json(results_in(folder.path())), to_json(after(n, whole())));
    }
    RecordJournal again(file, "scene");
    again.forget();
    again.append(after(2, whole()));
    EXPECT_EQ(to_json(results_in(folder.path())), to_json(after(2, whole())));
    RecordJournal other(file, "another scene");
    EXPECT_TRUE(other.earlier().records.empty());
    other.append(after(1, whole())); // in its place
    EXPECT_EQ(to_json(results_in(folder.path())), to_json(after(1, whole())));
  }

  // After an interrupt results.json has what was concluded from the same records.
  TEST(StaticsJournal, is_left_out_where_results_are_written)
  {
    const fixture::Folder folder;
    study::StudyResults interrupted = after(2, whole());
    RecordJournal journal(folder.path() / "results.jsonl", "scene");
    journal.append(interrupted);
    interrupted.facts["concluded"] = "something";
    std::ofstream(folder.path() / "results.json") << to_json(interrupted);
    EXPECT_EQ(to_json(results_in(folder.path())), to_json(interrupted));
    journal.append(made(3)); // and killed
    EXPECT_EQ(to_json(results_in(folder.path())), to_json(after(3, whole())));
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
    EXPECT_THROW(journal.append(made(2)), InputError);
  }
} // namespace plumbline::io
