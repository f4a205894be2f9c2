// Charts as PDF, from the scripts that draw them as SVG.
#include "report/pdf.h"
#include "base/error.h"
#include "report/data_charts.h"
#include "report/view.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace
{
  using namespace plumbline;
  using namespace plumbline::report;
  namespace fs = std::filesystem;
} // namespace

TEST(Pdf, is_drawn_beside_each_svg_of_the_same_size)
{
  const fixture::Folder folder;
  write_study(statics_view(fixture::results()), fixture::results(), folder.path());
  draw_pdf(folder.path());
  std::size_t n = 0;
  for (const auto &one : fs::directory_iterator(folder.path() / "charts"))
    if (one.path().extension() == ".svg")
    {
      ++n;
      const std::string pdf = fixture::read(fs::path(one.path()).replace_extension(".pdf"));
      EXPECT_EQ(pdf.substr(0, 5), "%PDF-") << one.path();
    }
    else
      EXPECT_EQ(one.path().string().find(".pdf.gp"), std::string::npos) << one.path();
  EXPECT_GT(n, 2u);
  const std::string svg = fixture::read(folder.path() / "charts" / "work-precision.svg"),
                    pdf = fixture::read(folder.path() / "charts" / "work-precision.pdf");
  EXPECT_NE(svg.find("viewBox=\"0 0 820 480\""), std::string::npos);   // pixels
  EXPECT_NE(pdf.find("/MediaBox [ 0 0 820 480 ]"), std::string::npos); // points
}

TEST(Pdf, takes_the_terminal_and_the_name_of_the_file_alone_from_a_script)
{
  const std::string title = "set title 'set output \'a.svg\''\n";
  EXPECT_EQ(pdf_script("set terminal svg size 72,144 dynamic enhanced font 'sans-serif,14'\n"
                       "set output 'a.svg'\n" +
                       title),
            "set terminal pdfcairo size 1.000000in,2.000000in enhanced font 'sans-serif,14' "
            "fontscale .75 linewidth 2 dashlength 2\nset output 'a.pdf'\n" +
                title);
  EXPECT_EQ(pdf_script("set terminal svg\nset output 'a.svg'\n"), ""); // of somebody else
  EXPECT_EQ(pdf_script("set output 'a.pdf'\n"), "");
}

TEST(Pdf, is_refused_with_a_remedy_where_gnuplot_has_no_terminal_for_it)
{
  EXPECT_NO_THROW(require_pdf());
  const fixture::Folder folder; // of a gnuplot that refuses
  base::write_file(folder.path() / "gnuplot", "#!/bin/sh\nexit 1\n");
  fs::permissions(folder.path() / "gnuplot", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  for (const std::string &only : {folder.path().string() + ":" + path, std::string("/nowhere")})
  {
    setenv("PATH", only.c_str(), 1);
    std::string message = "no error";
    try
    {
      require_pdf();
    }
    catch (const InputError &error)
    {
      message = error.what();
    }
    setenv("PATH", path.c_str(), 1);
    EXPECT_NE(message.find("apt-get install gnuplot-nox, or leave out --pdf"), std::string::npos)
        << message;
  }
}
