// The page, numbers and pictures of `plumbline grow`.

#include "study/growth.h"
#include "report/formats.h"
#include "report/view.h"
#include "study/seeds.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    /// 8 x 4 nodes, the upper half tougher; a crack of two sides behind a notch of three, and a
    /// side apart from both.
    study::GrowthFindings found()
    {
      study::GrowthFindings r;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 8; ++i)
        {
          r.nodes.push_back({i + .5, j - 1.5});
          r.toughness.push_back(j < 2 ? 2 : 8);
        }
      r.notch_tip = {3, 0};
      for (int i = 0; i < 3; ++i)
        r.path.notch.push_back({{{1. * i, 0}, {i + 1., 0}}});
      r.path.sides = {{{{{3, 0}, {4, 0}}}, 0, true},
                      {{{{4, 0}, {4, -1}}}, 1, true},
                      {{{{6, 1}, {7, 1}}}, 1, false}};
      r.path.tips = {{4, 0}, {4, -1}};
      r.path.width = 2;
      r.path.n_elsewhere = 1;
      analysis::Event event;
      event.critical = event.load = .4;
      event.bonds = {3};
      event.reaction_before = 2;
      event.reaction = 1.5;
      event.work = 1;
      event.stored = event.in_bonds = .5;
      r.growth.events = {event, event};
      r.growth.events[1].critical = r.growth.events[1].load = .5;
      r.growth.events[1].bonds = {4, 5};
      r.growth.events[1].reaction_before = 1.9;
      r.growth.events[1].reaction = .25;
      r.growth.end = problem::GrowthEnd::parted;
      r.growth.last_load = .5;
      r.growth.is_separated = true;
      r.moments = {{0, 0, std::vector<double>(32, 0)}, {2, .5, std::vector<double>(32, .25)}};
      return r;
    }

    study::StudyResults grown(const study::GrowthFindings &findings = found())
    {
      study::StudyResults results;
      results.analysis = "grow";
      results.scene_name = "two_phases";
      results.scene_text = "# Two phases\nsubsection Random\n  set field = ellipses # <b>\nend\n";
      Record record;
      record.key.method = "OPT";
      record.key.h = 1;
      record.key.horizon = 3;
      record.texts["seeds"] = "The field is drawn whole: Random/seed = 7, Random/realisation = 3";
      results.records = {growth_record(record, findings)};
      return results;
    }

    void write(const study::StudyResults &results, const fixture::Folder &folder)
    {
      write_study(growth_view(results), results, folder.path());
    }

    std::string text_of(const study::StudyResults &results)
    {
      const View view = growth_view(results);
      std::string model;
      for (const Part &part : view.parts)
        model += part.id == "model" ? part.words : "";
      return model + "\n" + study_summary(view, results, "grow.html");
    }

    std::string in_one_line(std::string text)
    {
      std::replace(text.begin(), text.end(), '\n', ' ');
      return text;
    }
  } // namespace

  TEST(GrowthReport, DrawsTheCrackOverTheMicrostructure)
  {
    const fixture::Folder folder;
    write(grown(), folder);
    const std::string script = fixture::read(folder.path() / "grow/pictures.gp");
    // G of the nodes, the lowest row first
    const std::string low = "2 2 2 2 2 2 2 2\n", high = "8 8 8 8 8 8 8 8\n";
    EXPECT_NE(script.find("$G << EOD\n" + low + low + high + high + "EOD\n"), std::string::npos)
        << script;
    // sides, of what each is
    for (const char *const sides :
         {"$notch << EOD\n0 0\n1 0\n\n1 0\n2 0\n\n2 0\n3 0\n\nEOD\n",
          "$crack << EOD\n3 0\n4 0\n\n4 0\n4 -1\n\nEOD\n", "$apart << EOD\n6 1\n7 1\n\nEOD\n"})
      EXPECT_NE(script.find(sides), std::string::npos) << sides << script;
    EXPECT_NE(script.find("load 0.5, 2 events"), std::string::npos);
    // drawn after the background, so that they lie on it
    const std::string picture = fixture::read(folder.path() / "grow/microstructure.svg");
    const std::size_t background = picture.find("<image");
    ASSERT_NE(background, std::string::npos);
    for (const char *const colour : {"rgb(213,  94,   0)", "rgb(  0, 114, 178)"})
      EXPECT_NE(picture.find(colour, background), std::string::npos) << colour;
    for (const char *const words : {"the crack", "separated elsewhere", "the notch"})
      EXPECT_NE(picture.find(words), std::string::npos) << words;
    const std::string page = fixture::read(folder.path() / "grow.html");
    EXPECT_EQ(fixture::count(page, "<image"), 3u); // of it, and of two moments
  }

  TEST(GrowthReport, HasUnitsOnTheAxesOfItsCharts)
  {
    const View view = growth_view(grown());
    const auto &charts = view.galleries.at(0).charts;
    ASSERT_EQ(charts.size(), 3u);
    for (const DataChart &chart : charts)
      EXPECT_TRUE(fixture::has_units(chart.plot)) << chart.name;
    EXPECT_EQ(charts[0].plot.x_label, "load factor [1]");
    EXPECT_EQ(charts[1].plot.y_label, "energy [force]"); // of a body of thickness 1 [length]
  }

  TEST(GrowthReport, DrawsNoMicrostructureThatIsNotThere)
  {
    const fixture::Folder folder;
    study::GrowthFindings findings = found();
    findings.toughness.assign(findings.nodes.size(), 2);
    write(grown(findings), folder);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "grow/microstructure.svg"));
    const std::string page = fixture::read(folder.path() / "grow.html");
    EXPECT_EQ(page.find("microstructure"), std::string::npos);
    EXPECT_EQ(fixture::count(page, "<image"), 2u);
  }

  TEST(GrowthReport, TellsTheSceneAndItsSeeds)
  {
    const fixture::Folder folder;
    const study::StudyResults results = grown();
    write(results, folder);
    const std::string seeds = "Random/seed = 7, Random/realisation = 3",
                      page = fixture::read(folder.path() / "grow.html"),
                      markdown = fixture::read(folder.path() / "grow.md");
    EXPECT_NE(page.find(escape_html(results.scene_text)), std::string::npos);
    EXPECT_NE(markdown.find(results.scene_text), std::string::npos);
    for (const std::string &text : {page, markdown})
      EXPECT_NE(text.find(seeds), std::string::npos) << text;
    EXPECT_NE(in_one_line(text_of(results)).find(seeds), std::string::npos);
  }

  TEST(GrowthReport, TellsNoSeedsThatDrawNothing)
  {
    scene::RandomSection random;
    EXPECT_EQ(study::seed_words(random), "");
    random.field = scene::FieldKind::ellipses;
    random.seed = 7;
    random.realisation = 3;
    EXPECT_NE(study::seed_words(random).find("Random/seed = 7, Random/realisation = 3"),
              std::string::npos);
    random.n_modes = 2; // of drawn ellipses
    EXPECT_NE(study::seed_words(random).find("Random/seed = 7"), std::string::npos);
    EXPECT_EQ(study::seed_words(random).find("Random/realisation"), std::string::npos);
    random.field = scene::FieldKind::matern;
    EXPECT_EQ(study::seed_words(random), "");
    study::StudyResults results = grown();
    results.records[0].texts.erase("seeds");
    EXPECT_EQ(text_of(results).find("Random/seed"), std::string::npos);
  }

  TEST(GrowthReport, TellsConnectionAndReactionWhicheverEndedIt)
  {
    study::GrowthFindings findings = found(); // parted, with a reaction of .25, which was 2
    study::StudyResults results = grown(findings);
    EXPECT_EQ(results.records[0].text("connected"), "no");
    EXPECT_EQ(results.records[0]["reaction left"], .125);
    const std::string no = "no bonds connect the grips, and the reaction is 0.125 of its peak",
                      yes = "bonds still connect the grips, and the reaction is 0.125 of its peak";
    EXPECT_NE(in_one_line(text_of(results)).find(no), std::string::npos);
    findings.growth.end = problem::GrowthEnd::unloaded;
    findings.growth.is_separated = false;
    results = grown(findings);
    EXPECT_EQ(results.records[0].text("connected"), "yes");
    EXPECT_NE(in_one_line(text_of(results)).find(yes), std::string::npos);
    const fixture::Folder folder;
    write(results, folder);
    for (const char *const file : {"grow.html", "grow.md"})
    {
      const std::string text = fixture::read(folder.path() / file);
      EXPECT_NE(text.find(yes), std::string::npos) << text;
      EXPECT_NE(text.find("reaction left"), std::string::npos) << text;
    }
  }

  TEST(GrowthReport, TellsThePartOfTheDeadLoadsThatActsAtTheEnd)
  {
    const auto text_with = [](double load_left)
    {
      study::GrowthFindings findings = found();
      findings.growth.is_separated = load_left == 0;
      findings.growth.load_left = load_left;
      study::StudyResults results = grown(findings);
      results.records[0].texts["pulled by"] = "dead loads";
      return in_one_line(text_of(results));
    };
    const std::string connect = "bonds still connect what is loaded with the grips";
    EXPECT_NE(text_with(.25).find(connect + ", and 0.25 of the dead loads act on connected nodes"),
              std::string::npos)
        << text_with(.25);
    EXPECT_NE(text_with(0).find("no bonds connect what is loaded with the grips."),
              std::string::npos)
        << text_with(0);
  }

  TEST(GrowthReport, AnswersBeforeItWarnsAndNamesFirstEvents)
  {
    const fixture::Folder folder;
    study::StudyResults results = grown();
    results.warnings = {"nodes are few"};
    write(results, folder);
    const std::string page = fixture::read(folder.path() / "grow.html");
    const std::size_t answer = page.find("<p class=\"answer\">");
    ASSERT_NE(answer, std::string::npos);
    EXPECT_LT(answer, page.find("nodes are few"));
    const std::string first = "<p class=\"answer\">The crack starts to grow at load 0.4 and";
    EXPECT_EQ(page.compare(answer, first.size(), first), 0) << page.substr(answer, 200);
    const std::string text = in_one_line(text_of(results));
    EXPECT_NE(text.find("load factor at which the first bond breaks (event 0"), std::string::npos)
        << text;
    EXPECT_NE(text.find("load factor at which the crack starts to grow (event"), std::string::npos)
        << text;
  }

  TEST(GrowthReport, DrawsDamageAtEveryMoment)
  {
    const fixture::Folder folder;
    write(grown(), folder);
    const std::string script = fixture::read(folder.path() / "grow/pictures.gp");
    const std::string whole = "0 0 0 0 0 0 0 0\n",
                      damaged = "0.25 0.25 0.25 0.25 0.25 0.25 0.25 0.25\n";
    EXPECT_NE(script.find("$m0 << EOD\n" + whole), std::string::npos) << script;
    EXPECT_NE(script.find("$m1 << EOD\n" + damaged), std::string::npos) << script;
    EXPECT_NE(fixture::read(folder.path() / "grow/moments.svg").find("</svg>"), std::string::npos);
  }
} // namespace plumbline::report
