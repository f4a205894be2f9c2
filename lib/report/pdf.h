#pragma once

#include <filesystem>
#include <string>

// Charts and maps as PDF, for papers: gnuplot draws its own scripts again, on its terminal
// pdfcairo.
namespace plumbline::report
{
  /// @throws InputError  gnuplot is missing, or has no terminal for PDF
  void require_pdf();

  /// The script that draws PDF files of the same names and sizes (one pixel is one point) in place
  /// of SVG.
  std::string pdf_script(const std::string &svg_script);

  /// Beside each SVG of the gnuplot scripts in a folder and the folders in it: the same as PDF.
  /// @throws NumericalError  a picture cannot be drawn
  void draw_pdf(const std::filesystem::path &folder);
} // namespace plumbline::report
