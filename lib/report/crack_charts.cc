#include "report/crack_charts.h"

#include "report/damage_maps.h"
#include "report/plot.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    using study::CrackResults;
    using study::CrackSample;

    struct Curve
    {
      std::string label, colour;
      bool is_dashed = false;
      std::vector<Vertex> points;
    };

    /// Lines over time on linear axes.
    /// @param y_from  where the axis begins; "*": with the lines
    std::string chart(const std::string &file, const std::string &title, const std::string &y_label,
                      const std::string &y_from, const std::vector<Curve> &curves)
    {
      std::ostringstream out;
      out << "\nreset\n";
      for (std::size_t i = 0; i < curves.size(); ++i)
      {
        out << "$c" << i << " << EOD\n";
        for (const Vertex &v : curves[i].points)
          out << exact(v.x) << " " << exact(v.y) << "\n";
        out << "EOD\n";
      }
      out << "set terminal svg size 820,440 dynamic enhanced font 'sans-serif,14' background "
             "'#ffffff'\nset output "
          << quote_gnuplot(file) << "\nset title " << quote_gnuplot(title)
          << " noenhanced font ',15'\nset border 3 lc rgb '#888888'\nset tics nomirror textcolor "
             "rgb '#222222'\nset grid lc rgb '#e2e6ea'\nset xlabel 't [time]'\nset ylabel "
          << quote_gnuplot(y_label) << " noenhanced\nset yrange [" << y_from
          << ":*]\nset key outside right top Left reverse noenhanced\nplot ";
      for (std::size_t i = 0; i < curves.size(); ++i)
        out << (i > 0 ? ", " : "") << "$c" << i << " using 1:2 with lines lw 2 lc rgb '"
            << curves[i].colour << "' dt " << (curves[i].is_dashed ? 2 : 1) << " title "
            << quote_gnuplot(curves[i].label);
      out << "\nunset output\n";
      return out.str();
    }

    template <typename Value>
    Curve curve(const CrackResults &results, const std::string &label, const std::string &colour,
                const Value &value)
    {
      Curve result{label, colour, false, {}};
      for (const CrackSample &sample : results.history.samples)
        result.points.push_back({sample.t, value(sample)});
      return result;
    }

    std::string tip_chart(const CrackResults &results)
    {
      const auto &samples = results.history.samples;
      Curve tip =
          curve(results, "crack tip", "#0072B2", [](const CrackSample &s) { return s.tip; });
      Curve wave{"Rayleigh wave", "#888888", true, {}};
      const double from = results.notch_tip,
                   highest = results.lower[0] + results.h() * results.n[0],
                   end = std::min(samples.back().t, (highest - from) / results.rayleigh_speed());
      wave.points = {{0, from}, {end, from + results.rayleigh_speed() * end}};
      return chart("tip.svg", "Where the crack ends", "x [length]", "*", {tip, wave});
    }

    std::string speed_chart(const CrackResults &results)
    {
      const auto &samples = results.history.samples;
      const std::size_t window = std::max<std::size_t>(1, (samples.size() - 1) / 20);
      Curve speed{"crack tip", "#0072B2", false, {}};
      for (std::size_t i = window; i < samples.size(); ++i)
        speed.points.push_back(
            {.5 * (samples[i].t + samples[i - window].t),
             (samples[i].tip - samples[i - window].tip) / (samples[i].t - samples[i - window].t) /
                 results.rayleigh_speed()});
      const double end = samples.back().t;
      const Curve one{"Rayleigh waves", "#888888", true, {{0, 1}, {end, 1}}};
      return chart("speed.svg", "How fast it runs", "speed over Rayleigh waves'", "0",
                   {speed, one});
    }

    std::string energy_chart(const CrackResults &results)
    {
      const auto part = [&](const std::string &label, const std::string &colour, auto value)
      { return curve(results, label, colour, value); };
      std::vector<Curve> curves = {
          part("sum", "#000000", [](const CrackSample &s) { return s.total(); }),
          part("bonds", "#0072B2", [](const CrackSample &s) { return s.bonds; }),
          part("soft ones of them", "#D55E00", [](const CrackSample &s) { return s.soft; }),
          part("kinetic", "#009E73", [](const CrackSample &s) { return s.kinetic; })};
      if (results.damping > 0)
        curves.push_back(
            part("dissipated", "#CC79A7", [](const CrackSample &s) { return s.dissipated; }));
      return chart("energies.svg", "Energies", "energy", "0", curves);
    }

    std::string moments_picture(const CrackResults &results)
    {
      std::vector<DamageMap> maps;
      for (const study::CrackMoment &moment : results.history.moments)
        maps.push_back({"t = " + rounded(moment.t), moment.damage});
      const double h = results.h();
      return damage_script(maps, "moments.svg", "Where bonds are soft",
                           {{results.lower[0] - .5 * h, results.lower[1] - .5 * h}, h, results.n});
    }
  } // namespace

  std::vector<CrackPicture> crack_pictures()
  {
    return {{"moments", "Where bonds are soft",
             "The part of each node's bonds that is soft or cut, on the body at rest, at six "
             "times; above and below it the grips. As VTU with displacements (Time/frames).",
             "frames", true},
            {"tip", "Where the crack ends", "", "crack/samples.csv"},
            {"speed", "How fast it runs", "Over a twentieth of the time.", "crack/samples.csv"},
            {"energies", "Energies",
             "Grips that stand still do no work: the sum stays as it is but for the error of the "
             "time steps.",
             "crack/samples.csv"}};
  }

  Table crack_samples_table(const CrackResults &results)
  {
    Table table;
    table.columns = {"t [time]",   "tip [length]", "kinetic", "bonds",
                     "soft bonds", "dissipated",   "branches"};
    for (const CrackSample &s : results.history.samples)
      table.rows.push_back({number_cell(s.t), number_cell(results.origin[0] + s.tip),
                            number_cell(s.kinetic), number_cell(s.bonds), number_cell(s.soft),
                            number_cell(s.dissipated), number_cell(s.n_branches)});
    return table;
  }

  void write_crack_pictures(const CrackResults &results, const std::filesystem::path &dir)
  {
    const std::filesystem::path folder = dir / "crack";
    write_file(folder / "samples.csv", to_csv(crack_samples_table(results)));
    write_file(folder / "charts.gp", tip_chart(results) + speed_chart(results) +
                                         energy_chart(results) + moments_picture(results));
    std::vector<std::string> files;
    for (const CrackPicture &picture : crack_pictures())
      files.push_back(picture.name + ".svg");
    run_gnuplot(folder, "charts.gp", files);
    sharpen(folder / "moments.svg");
  }
} // namespace plumbline::report
