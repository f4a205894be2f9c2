#pragma once

#include <filesystem>
#include <string>

// Charts and maps as PDF, for papers: gnuplot runs the same scripts again, with its terminal
// pdfcairo.
namespace plumbline::report
{
  /// @throws InputError  gnuplot is missing, or has no terminal for PDF
  void require_pdf();

  /// The script that draws PDF files of the same names and sizes (one pixel is one point) in place
  /// of SVG.
  std::string pdf_script(const std::string &svg_script);

  /// Draws a PDF beside each SVG of the gnuplot scripts in a folder and its subfolders.
  /// @throws NumericalError  a picture cannot be drawn
  void draw_pdf(const std::filesystem::path &folder);
} // namespace plumbline::report
