// What is found out of a growth: its path, mirror images, moments, what is expected; checkpoints.

#include "study/growth.h"

#include "analysis/checkpoint.h"
#include "base/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace
{
  using namespace plumbline;
  using analysis::Event;
  using study::bonds_across;
  using study::broken_parts;
  using study::find_path;
  using study::growth_moments;
  using study::growth_record;
  using study::GrowthFindings;
  using study::GrowthModel;
  using study::n_unpaired;
  using study::run_growth;

  /// Rows at y = -1.5, -.5, .5, 1.5 of so many columns, bonds between next neighbours along y;
  /// the notch cuts those of the first three columns.
  GrowthModel comb(unsigned int n_columns)
  {
    GrowthModel model;
    model.h = 1;
    for (int j = 0; j < 4; ++j)
      for (unsigned int i = 0; i < n_columns; ++i)
        model.nodes.push_back({i + .5, j - 1.5});
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int i = 0; i < n_columns; ++i)
        (j == 1 && i < 3 ? model.cut : model.bonds)
            .push_back({j * n_columns + i, (j + 1) * n_columns + i});
    model.notch_tip = {3, 0};
    model.damage = [n = model.nodes.size()](const std::vector<std::size_t> &broken)
    { return std::vector<double>(n, static_cast<double>(broken.size())); };
    return model;
  }

  /// The bond of a column between two rows.
  std::size_t bond(const GrowthModel &model, double x, double y)
  {
    for (std::size_t b = 0; b < model.bonds.size(); ++b)
    {
      const auto middle = model.nodes[model.bonds[b][0]] +
                          .5 * (model.nodes[model.bonds[b][1]] - model.nodes[model.bonds[b][0]]);
      if (middle.distance({x, y}) < 1e-9)
        return b;
    }
    throw InputError("no such bond");
  }

  /// Layers z = 0, 1, ... like `comb`, bonds between layers too.
  plumbline::method::BreakableBody<3> combs(unsigned int n_columns, unsigned int n_layers)
  {
    const GrowthModel flat = comb(n_columns);
    const auto n = static_cast<unsigned int>(flat.nodes.size());
    plumbline::method::BreakableBody<3> model;
    model.h = 1;
    model.notch_tip = flat.notch_tip;
    for (unsigned int k = 0; k < n_layers; ++k)
    {
      for (const auto &x : flat.nodes)
        model.nodes.push_back({x[0], x[1], k + 0.});
      for (const auto &[from, to] : flat.bonds)
        model.bonds.push_back({from + k * n, to + k * n});
      for (const auto &[from, to] : flat.cut)
        model.cut.push_back({from + k * n, to + k * n});
    }
    for (unsigned int i = 0; i < (n_layers - 1) * n; ++i)
      model.bonds.push_back({i, i + n});
    return model;
  }

  /// G of each bond is the mean of its ends'.
  void take_means(GrowthModel &model)
  {
    model.toughness_of_bonds.clear();
    for (const auto &[from, to] : model.bonds)
      model.toughness_of_bonds.push_back(.5 * (model.toughness[from] + model.toughness[to]));
  }

  Event event(const std::vector<std::size_t> &bonds, double load = 1)
  {
    Event result;
    result.bonds = bonds;
    result.critical = result.load = load;
    return result;
  }

  std::ptrdiff_t n_missed(const GrowthFindings &found, const scene::ExpectedSection &expected)
  {
    const auto all = study::check_crack_growth(growth_record({}, found), expected);
    return std::count_if(all.begin(), all.end(),
                         [](const study::Expectation &one) { return !one.holds; });
  }

  /// Four bonds that no load breaks.
  class Body : public method::QuasistaticFractureModel
  {
  public:
    Body() { response_.critical_loads.assign(4, std::numeric_limits<double>::infinity()); }
    std::size_t n_bonds() const override { return 4; }
    std::size_t n_unknowns() const override { return 0; }
    const Response &response() const override { return response_; }
    Release break_bonds(const std::vector<std::size_t> &) override { return {}; }
    void restart(const std::vector<std::size_t> &) override {}
    bool is_separated() const override { return is_in_two; }
    std::optional<double> load_left() const override { return part_of_loads; }
    const Work &work() const override { return work_; }

    bool is_in_two = false;
    std::optional<double> part_of_loads;

  private:
    Response response_;
    Work work_;
  };
} // namespace

TEST(Growth, a_path_hangs_together_with_the_notch)
{
  const GrowthModel model = comb(8);
  // one that is joined later, one apart, and one on the notch's line
  const std::vector<Event> events = {event({bond(model, 4.5, 0)}), event({bond(model, 7.5, 1)}),
                                     event({bond(model, 3.5, 0)})};
  const study::CrackPath path = find_path(model, events);
  ASSERT_EQ(path.tips.size(), 3u);
  EXPECT_LT(path.tips[0].distance({3, 0}), 1e-12);
  EXPECT_LT(path.tips[1].distance({3, 0}), 1e-12);
  EXPECT_LT(path.tips[2].distance({5, 0}), 1e-12);
  EXPECT_EQ(path.n_elsewhere, 1u);
  EXPECT_EQ(path.sides[2].event, 2u);
  ASSERT_EQ(path.notch.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    for (const auto &end : path.notch[i])
    {
      EXPECT_NEAR(end[0], i + .5, .5 + 1e-12);
      EXPECT_NEAR(end[1], 0, 1e-12);
    }
}

TEST(Growth, a_path_may_step_to_the_next_row)
{
  const GrowthModel model = comb(8);
  const std::vector<Event> events = {event({bond(model, 3.5, 0)}), event({bond(model, 4.5, 1)}),
                                     event({bond(model, 6.5, 0)}), event({bond(model, 7.5, -1)})};
  const study::CrackPath path = find_path(model, events);
  EXPECT_LT(path.tips[1].distance({5, 1}), 1e-12);
  EXPECT_LT(path.tips[3].distance({5, 1}), 1e-12); // not along a row, across a column that is whole
  EXPECT_EQ(path.n_elsewhere, 2u);
}

TEST(Growth, a_crack_begins_where_the_first_neighbours_part_if_there_is_no_notch)
{
  GrowthModel model = comb(8);
  model.bonds.insert(model.bonds.end(), model.cut.begin(), model.cut.end());
  model.cut.clear();
  model.bonds.push_back({0, 8 + 1}); // not between next neighbours
  const std::size_t oblique = model.bonds.size() - 1;
  const std::vector<Event> events = {event({oblique}), event({bond(model, 4.5, 0)}),
                                     event({bond(model, 7.5, 1)}), event({bond(model, 3.5, 0)})};
  EXPECT_FALSE(study::find_nucleus(model, {events[0]}));
  const auto nucleus = study::find_nucleus(model, events);
  ASSERT_TRUE(nucleus);
  EXPECT_LT(nucleus->distance({4.5, 0}), 1e-12);
  model.notch_tip = *nucleus;
  GrowthFindings found;
  found.growth.events = events;
  found.notch_tip = *nucleus;
  found.origin = {10, 20};
  found.path = find_path(model, events);
  EXPECT_TRUE(found.path.notch.empty());
  EXPECT_EQ(found.path.n_elsewhere, 1u);
  EXPECT_LT(found.path.tips[0].distance({4.5, 0}), 1e-12);
  EXPECT_LT(found.path.tips[3].distance({3, 0}), 1e-12);
  const analysis::Record record = growth_record({}, found);
  EXPECT_EQ(record["nucleus x"], 14.5);
  EXPECT_EQ(record["nucleus y"], 20);
  EXPECT_EQ(record["first advance event"], 1);
  EXPECT_NEAR(record["advance"], 1.5, 1e-12);
}

TEST(Growth, begins_at_the_first_break_and_at_the_first_advance)
{
  const GrowthModel model = comb(8);
  GrowthFindings found;
  found.notch_tip = model.notch_tip;
  found.growth.events = {event({bond(model, 6.5, 0)}, 2), event({bond(model, 3.5, 0)}, 2.5),
                         event({bond(model, 4.5, 0)}, 4)};
  found.path = find_path(model, found.growth.events);
  const analysis::Record record = growth_record({}, found);
  EXPECT_EQ(record["first break"], 2); // ahead of the tip
  EXPECT_EQ(record["first advance"], 2.5);
  EXPECT_EQ(record["first advance event"], 1);
  found.growth.events.resize(1);
  found.path = find_path(model, found.growth.events);
  EXPECT_FALSE(growth_record({}, found).has("first advance"));
}

TEST(Growth, toughness_counts_bonds_over_the_width_of_what_parted)
{
  GrowthModel model = comb(8);
  model.bonds.push_back({8 + 5, 8 + 6}); // along a row: the side of its cells stands upright
  const std::size_t along = model.bonds.size() - 1;
  model.toughness.assign(model.nodes.size(), 2);
  model.toughness[8 + 4] = 8; // one end of the second bond that breaks, and of the third
  take_means(model);
  const std::vector<std::size_t> broken = {bond(model, 3.5, 0), bond(model, 4.5, 0),
                                           bond(model, 4.5, 1), along};
  EXPECT_EQ(bonds_across(model), 1);
  GrowthFindings found;
  found.growth.events = {event(broken)};
  found.growth.events[0].in_bonds = 6;
  found.growth.events[0].released = 4;
  found.path = find_path(model, found.growth.events);
  EXPECT_EQ(found.path.width, 2); // two columns, one of them twice
  const auto parts = broken_parts(model, broken);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].toughness, 2);
  EXPECT_EQ(parts[0].n_bonds, 3u);
  EXPECT_EQ(parts[0].length, 3);
  EXPECT_EQ(parts[1].toughness, 5);
  EXPECT_EQ(parts[1].length, 1);
  found.parts = parts;
  found.plane_modulus = 8;
  const analysis::Record record = growth_record({}, found);
  EXPECT_EQ(record["G by bonds"], 11. / 2);
  EXPECT_EQ(record["G by energy"], 10. / 2);
  EXPECT_NEAR(record["K by bonds"], std::sqrt(44), 1e-14);
  EXPECT_NEAR(record["K by energy"], std::sqrt(40), 1e-14);
  found.path.width = 0;
  EXPECT_FALSE(growth_record({}, found).has("G by bonds"));
}

TEST(Growth, lengths_are_those_within_phases_and_between_them)
{
  GrowthModel model = comb(8);
  model.toughness.assign(model.nodes.size(), 8);
  for (std::size_t i = 0; i < 2 * 8; ++i) // what lies below the notch is weaker
    model.toughness[i] = 2;
  const std::vector<std::size_t> broken = {
      bond(model, 3.5, 0),  bond(model, 4.5, 0),  bond(model, 5.5, 0), bond(model, 6.5, 0),
      bond(model, 4.5, -1), bond(model, 5.5, -1), bond(model, 4.5, 1)};
  GrowthFindings found;
  const auto quantity = [&](const std::string &name) { return growth_record({}, found)[name]; };
  const auto phases = [&] { return growth_record({}, found).curves.at("phases")[0].values; };
  take_means(model);
  found.toughness = model.toughness;
  found.parts = broken_parts(model, broken);
  EXPECT_EQ(phases(), (std::vector<double>{2, 8}));
  EXPECT_EQ(quantity("L1"), 2);
  EXPECT_EQ(quantity("L2"), 1);
  EXPECT_EQ(quantity("Li"), 4);
  // nothing of one of them is broken
  found.parts = broken_parts(model, {broken[0]});
  EXPECT_EQ(quantity("L1"), 0);
  EXPECT_EQ(quantity("L2"), 0);
  EXPECT_EQ(quantity("Li"), 1);
  // one phase is all
  model.toughness.assign(model.nodes.size(), 8);
  take_means(model);
  found.toughness = model.toughness;
  found.parts = broken_parts(model, broken);
  EXPECT_EQ(phases(), (std::vector<double>{8}));
  EXPECT_EQ(quantity("L1"), 7);
  EXPECT_EQ(quantity("L2"), 0);
  EXPECT_EQ(quantity("Li"), 0);
  // three are none that have names
  model.toughness[0] = 1;
  model.toughness[1] = 3;
  take_means(model);
  found.toughness = model.toughness;
  found.parts = broken_parts(model, broken);
  EXPECT_TRUE(phases().empty());
  for (const char *const name : {"L1", "L2", "Li"})
  {
    EXPECT_TRUE(std::isnan(quantity(name))) << name;
    scene::ExpectedSection expected;
    expected.growth = {{name, 0}};
    EXPECT_EQ(n_missed(found, expected), 1); // what is not known is not as expected
  }
}

TEST(Growth, mirror_images_are_paired)
{
  const GrowthModel model = comb(8);
  EXPECT_EQ(n_unpaired(model, {bond(model, 4.5, 0)}, 1, 0), 0u);
  EXPECT_EQ(n_unpaired(model, {bond(model, 4.5, 1), bond(model, 4.5, -1)}, 1, 0), 0u);
  EXPECT_EQ(n_unpaired(model, {bond(model, 4.5, 1), bond(model, 5.5, -1)}, 1, 0), 2u);
}

TEST(Growth, moments_are_even_parts_of_what_breaks)
{
  const GrowthModel model = comb(8);
  std::vector<Event> events;
  for (std::size_t b = 0; b < 10; ++b)
    events.push_back(event({b}));
  const auto moments = growth_moments(model, events);
  ASSERT_EQ(moments.size(), study::n_growth_moments);
  for (std::size_t i = 0; i < moments.size(); ++i)
  {
    EXPECT_EQ(moments[i].n_events, 2 * i);
    EXPECT_EQ(moments[i].damage.front(), 2. * static_cast<double>(i));
  }
  EXPECT_EQ(growth_moments(model, {}).size(), 1u);
}

TEST(Growth, expectations_and_the_audit_are_held_against_it)
{
  GrowthFindings found;
  found.growth.end = problem::GrowthEnd::parted;
  found.growth.events = {event({1, 2}, 2), event({3}, 3)};
  found.path.tips.resize(2);
  for (Event &one : found.growth.events)
  {
    one.work = 2;
    one.stored = one.in_bonds = 1;
    one.reaction_before = 5 - one.load;
  }
  scene::ExpectedSection expected;
  EXPECT_EQ(n_missed(found, expected), 0);
  expected.growth = {{"broken bonds", 3}, {"events", 2}, {"peak load", 2}, {"peak reaction", 3}};
  expected.growth_end = problem::GrowthEnd::parted;
  EXPECT_EQ(n_missed(found, expected), 0);
  expected.growth["peak load"] = 2.1;
  expected.growth_end = problem::GrowthEnd::loaded;
  EXPECT_EQ(n_missed(found, expected), 2);
  found.growth.events[1].released = 1e-9; // which nobody did
  EXPECT_EQ(n_missed(found, expected), 3);
}

TEST(Growth, what_is_left_of_the_reaction_is_that_at_the_end)
{
  analysis::Growth growth;
  EXPECT_EQ(growth.reaction_left(), 1); // nothing broke
  growth.events = {event({1}, 2), event({2}, 4)};
  growth.events[0].reaction_before = 10;
  growth.events[0].reaction = 3;
  growth.events[1].reaction_before = 6;
  growth.events[1].reaction = 2;
  growth.last_load = 4;
  EXPECT_EQ(growth.reaction_left(), .2); // of the first event's, not of the last one's
  growth.last_load = 8;
  EXPECT_EQ(growth.reaction_left(), .4); // it rises with the load
  growth.last_load = 40;
  EXPECT_EQ(growth.reaction_left(), 1); // beyond all before
}

TEST(Growth, records_what_is_left_of_the_dead_loads_if_there_are_any)
{
  Body body;
  GrowthFindings found;
  found.growth = analysis::grow(body, {});
  EXPECT_FALSE(growth_record({}, found).has("load left"));
  body.part_of_loads = .25;
  found.growth = analysis::grow(body, {});
  EXPECT_EQ(growth_record({}, found)["load left"], .25);
}

TEST(Growth, says_whether_the_body_has_parted)
{
  Body body;
  const analysis::Growth whole = analysis::grow(body, {});
  EXPECT_EQ(whole.end, problem::GrowthEnd::whole);
  EXPECT_FALSE(whole.is_separated);
  body.is_in_two = true;
  const analysis::Growth parted = analysis::grow(body, {});
  EXPECT_EQ(parted.end, problem::GrowthEnd::parted);
  EXPECT_TRUE(parted.is_separated);
}

TEST(Growth, a_checkpoint_that_is_not_its_own_is_refused)
{
  GrowthModel model;
  model.body = std::make_shared<Body>();
  const study::Checkpoints checkpoints{std::filesystem::temp_directory_path() / "plumbline_growth"};
  std::filesystem::create_directories(checkpoints.folder);
  const auto file = checkpoints.file();
  const study::GrowthPlan plan{{}, "body", checkpoints};
  const auto grown_from = [&](const std::string &subject, const std::vector<double> &records)
  {
    analysis::write_checkpoint(file.string(), {subject, {}, records});
    return run_growth(*model.body, plan).n_resumed;
  };
  const std::vector<double> one = {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 2, 3, 1};
  EXPECT_EQ(grown_from("body", one), 1u);
  EXPECT_EQ(grown_from("another body", one), 0u);
  for (const std::vector<double> &wrong : std::vector<std::vector<double>>{
           {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 2, 3},    // too short
           {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 2, 3, 4}, // no such bond
           {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 2, 3, 3}, // one that broke already
           {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0},       // no bond
           {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, -1, 3}})
    EXPECT_THROW(grown_from("body", wrong), InputError);
  std::filesystem::remove_all(checkpoints.folder);
}

TEST(CrackFront, is_the_tip_of_each_layer)
{
  const GrowthModel flat = comb(8);
  const auto model = combs(8, 3);
  const std::size_t in_layer = flat.bonds.size();
  const auto broken = [&](double x, double y, std::size_t layer)
  { return bond(flat, x, y) + layer * in_layer; };
  std::vector<Event> events(4);
  events[0].bonds = {broken(3.5, 0, 1)};
  events[1].bonds = {broken(4.5, 0, 1), 3 * in_layer + 5};  // the second goes along z
  events[2].bonds = {broken(3.5, 0, 0), broken(7.5, 0, 2)}; // the second is apart
  events[3].bonds = {broken(3.5, 0, 2)};
  const study::CrackFront front = study::find_front(model, events);
  EXPECT_EQ(front.z, (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(front.way,
            (std::vector<std::vector<double>>{{0, 1, 0}, {0, 2, 0}, {1, 2, 0}, {1, 2, 1}}));
  EXPECT_EQ(front.n_elsewhere, 1u);
  EXPECT_EQ(front.area, 5);
  EXPECT_EQ(bonds_across(model), 1);
  std::vector<std::size_t> all;
  for (const Event &event : events)
    all.insert(all.end(), event.bonds.begin(), event.bonds.end());
  EXPECT_EQ(study::n_unpaired(model, all, 1, 0), 1u); // all but the one along z lie across y = 0
  EXPECT_EQ(study::n_unpaired(model, {all[0], all[1]}, 2, 1), 0u);
  EXPECT_EQ(study::n_unpaired(model, {broken(4.5, 0, 0)}, 2, 1), 1u);
}

// Full areas at m = 2: by rise times number, bonds within a layer have 1 + 2 + 2, those to the
// next layers 2 + 4, which the outer layers have to one side only.
TEST(CrackFront, begins_in_the_layer_whose_neighbours_part_first_if_there_is_no_notch)
{
  auto model = combs(6, 3);
  const std::size_t along_z = model.bonds.size() - 1;
  const auto broken = [&](double x, double y, double z)
  {
    for (std::size_t b = 0; b < model.bonds.size(); ++b)
      if (const auto &from = model.nodes[model.bonds[b][0]], &to = model.nodes[model.bonds[b][1]];
          (from + .5 * (to - from)).distance({x, y, z}) < 1e-9)
        return b;
    throw InputError("no such bond");
  };
  EXPECT_FALSE(study::find_nucleus(model, {event({along_z})}));
  const std::vector<Event> events = {event({along_z}), event({broken(4.5, 0, 1)}),
                                     event({broken(3.5, 1, 0)})};
  const auto nucleus = study::find_nucleus(model, events);
  ASSERT_TRUE(nucleus);
  EXPECT_LT(nucleus->distance({4.5, 0, 1}), 1e-12);
  study::FrontFindings found;
  found.nucleus = nucleus;
  found.growth.events = events;
  found.front = study::find_front(model, events);
  const analysis::Record record = growth_record({}, found);
  EXPECT_EQ(record["nucleus x"], 4.5);
  EXPECT_EQ(record["nucleus y"], 0);
  EXPECT_EQ(record["nucleus z"], 1);
}

TEST(CrackFront, counts_bonds_across_a_plane_on_the_mean_over_the_thickness)
{
  constexpr int n = 9;
  for (const int n_layers : {2, 5})
  {
    plumbline::method::BreakableBody<3> model;
    model.h = 1;
    for (int z = 0; z < n_layers; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
          model.nodes.emplace_back(x, y, z);
    for (unsigned int i = 0; i < model.nodes.size(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        if ((model.nodes[i] - model.nodes[j]).norm_square() < 4 + 1e-9)
          model.bonds.push_back({i, j});
    EXPECT_NEAR(bonds_across(model), 5 + 6. * (n_layers - 1) / n_layers, 1e-12) << n_layers;
  }
}
