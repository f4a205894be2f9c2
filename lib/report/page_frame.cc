#include "report/formats.h"
#include "report/page_parts.h"

#include <fstream>
#include <iterator>

namespace plumbline::report::page
{
  std::string document(const std::string &name, const std::string &what, const std::string &head,
                       const std::string &content)
  {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
           "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           escape_html(name) + " – Plumbline " + what + "</title>\n<style>" + style_sheet +
           "</style>\n</head>\n<body>\n" + head + "<main>\n" + content +
           "</main>\n</body>\n</html>\n";
  }

  std::string plain_header(const std::string &name, const std::string &what,
                           const std::string &purpose, const std::vector<std::string> &facts)
  {
    std::string text = "<header>\n<div class=\"brand\">Plumbline " + what + "</div>\n<h1>" +
                       escape_html(name) + "</h1>\n";
    if (!purpose.empty())
      text += "<p class=\"purpose\">" + escape_html(purpose) + "</p>\n";
    text += "<ul class=\"facts\">\n";
    for (const std::string &fact : facts)
      text += "<li>" + escape_html(fact) + "</li>";
    return text + "\n</ul>\n</header>\n";
  }

  std::string figure(const std::filesystem::path &picture, const std::string &prefix,
                     const std::string &title, const std::string &caption, bool is_large)
  {
    std::ifstream in(picture, std::ios::binary);
    const std::string svg((std::istreambuf_iterator<char>(in)), {});
    return std::string(is_large ? "<figure class=\"large\">\n" : "<figure>\n") +
           (svg.empty() ? "<p class=\"warning\">" + escape_html(title) +
                              ": not drawn; install gnuplot-nox and run again.</p>\n"
                        : inline_svg(svg, prefix, title)) +
           "<figcaption>" + caption + "</figcaption>\n</figure>\n";
  }
} // namespace plumbline::report::page
