#include "report/template.h"

#include "report/page_parts.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace plumbline::report
{
  TEST(Template, escapes_texts_but_not_what_is_html_already)
  {
    const Data data = {{"text", "a < b & 'c'"}, {"html", "<b>d</b>"}, {"n", 3}};
    EXPECT_EQ(fill_text("{{text}} {{{html}}} {{n}}", data),
              "a &lt; b &amp; &#39;c&#39; <b>d</b> 3");
  }

  TEST(Template, takes_empty_texts_and_null_for_what_is_not_there)
  {
    const std::string text = "{{# a}}[{{.}}]{{/ a}}{{^ a}}none{{/ a}}";
    EXPECT_EQ(fill_text(text, {{"a", "x"}}), "[x]");
    EXPECT_EQ(fill_text(text, {{"a", ""}}), "none");
    EXPECT_EQ(fill_text(text, {{"a", Data()}}), "none");
    EXPECT_EQ(fill_text(text, {{"a", Data::array({"x", "y"})}}), "[x][y]");
    EXPECT_EQ(fill_text(text, {{"a", Data::array()}}), "none");
    EXPECT_EQ(fill_text(text, {{"a", 0}}), "[0]"); // a number is a text
  }

  TEST(Template, never_leaves_out_silently_what_it_was_not_given)
  {
    for (const char *text : {"{{b}}", "{{# b}}x{{/ b}}", "{{^ b}}x{{/ b}}", "{{> no_such_part}}",
                             "{{# a}}never closed"})
      EXPECT_THROW(fill_text(text, {{"a", "x"}}), std::logic_error) << text;
    EXPECT_THROW(fill("no_such_page", {{"a", "x"}}), std::logic_error);
  }

  TEST(Template, of_a_table_aligns_numbers_and_of_an_empty_one_shows_nothing)
  {
    Table table;
    table.columns = {"method", "error"};
    EXPECT_TRUE(page::table(table).is_null());
    table.rows = {{text_cell("A<B"), error_cell(.125)}};
    const std::string html = fill("table", page::table(table));
    EXPECT_NE(html.find("<th>method</th><th class=\"n\">error</th>"), std::string::npos) << html;
    EXPECT_NE(html.find("<tr><td>A&lt;B</td><td class=\"n\">1.250e-1</td></tr>"), std::string::npos)
        << html;
  }
} // namespace plumbline::report
