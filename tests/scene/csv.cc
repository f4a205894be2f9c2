#include "base/csv.h"

#include "base/error.h"
#include "scene/mesh.h"

#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

using namespace plumbline;
using namespace plumbline::base;
using namespace plumbline::scene;

namespace
{
  class CsvFile : public testing::Test
  {
  protected:
    void TearDown() override { std::filesystem::remove(file_); }

    Csv open(const std::string &text, const std::vector<std::string> &required = {"a", "b"}) const
    {
      std::ofstream(file_) << text;
      return {file_, required};
    }

    /// What reading all of it as numbers says.
    std::string fault(const std::string &text) const
    {
      return error_of(
          [&]
          {
            Csv csv = open(text);
            while (csv.next())
            {
              csv.integer("a");
              csv.number("b");
            }
          });
    }

    template <class F>
    std::string error_of(const F &f) const
    {
      try
      {
        f();
      }
      catch (const InputError &error)
      {
        const std::string message = error.what(), file = "'" + file_ + "'";
        EXPECT_EQ(message.find(file), 0u) << message;
        return message.substr(file.size());
      }
      return "no error";
    }

    const std::string file_ =
        (std::filesystem::path(testing::TempDir()) / ("csv_" + std::to_string(getpid()))).string();
  };
} // namespace

TEST_F(CsvFile, is_read_by_the_names_of_its_columns)
{
  Csv csv = open("b, label ,a\r\n.5,two words,-7\r\n\n , \n+1e-1,,+12\n-2 ,c");
  EXPECT_TRUE(csv.has("label"));
  EXPECT_FALSE(csv.has("c"));
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.line(), 2u);
  EXPECT_EQ(csv.number("b"), .5);
  EXPECT_EQ(csv.integer("a"), -7);
  EXPECT_FALSE(csv.is_empty("label"));
  ASSERT_TRUE(csv.next()); // lines without values do not count
  EXPECT_EQ(csv.line(), 5u);
  EXPECT_EQ(csv.number("b"), .1);
  EXPECT_EQ(csv.integer("a"), 12);
  EXPECT_EQ(csv.number("a"), 12);
  EXPECT_TRUE(csv.is_empty("label"));
  ASSERT_TRUE(csv.next()); // a short row
  EXPECT_EQ(csv.number("b"), -2);
  EXPECT_TRUE(csv.is_empty("a"));
  EXPECT_FALSE(csv.next());
}

TEST_F(CsvFile, with_a_header_that_will_not_do_is_refused)
{
  EXPECT_EQ(fault("a,c\n1,2\n"),
            " has no column b in its first line 'a,c'; name the columns there: a,b");
  EXPECT_EQ(fault(""), " has no column a in its first line ''; name the columns there: a,b");
  EXPECT_EQ(fault("a,b,a\n"), ", line 1: two columns are named a; rename one of them");
  EXPECT_EQ(fault("a,b,,\n"), "no error"); // columns without a name
  std::filesystem::remove(file_);
  const std::string unreadable = " cannot be read; check its name and folder";
  EXPECT_EQ(error_of([&] { Csv(file_, {}); }), unreadable);
  std::filesystem::create_directory(file_);
  EXPECT_EQ(error_of([&] { Csv(file_, {}); }), unreadable);
}

TEST_F(CsvFile, names_line_column_and_value_that_are_wrong)
{
  EXPECT_EQ(fault("a,b\n1,2\n\n3,4x\n"),
            ", line 4: b = '4x' is not a finite number; mend or take out the line");
  for (const std::string bad :
       {"", "x", "nan", "-inf", "+", "+-1", "--1", "1 2", "0x1p3", "1e999", "1.5.2"})
    EXPECT_EQ(fault("a,b\n1," + bad + "\n").find(", line 2: b = '" + bad + "' is not a finite"), 0u)
        << bad << ": " << fault("a,b\n1," + bad + "\n");
  for (const std::string bad : {"1.0", "1e3", "9223372036854775808", "one"})
    EXPECT_EQ(fault("a,b\n" + bad + ",2\n").find(", line 2: a = '" + bad + "' is not an integer"),
              0u)
        << bad;
  // as decimal commas make it
  EXPECT_EQ(fault("a,b\n1,2\n1,0,2\n"), ", line 3: '1,0,2' has 3 values for 2 columns; take some "
                                        "out, or name their columns in the first line");
  Csv csv = open("a,b\n1,2\n");
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(error_of([&] { csv.fail("is odd"); }), ", line 2: is odd");
  EXPECT_EQ(error_of([&] { csv.fail(7, "is odd"); }), ", line 7: is odd");
}

TEST_F(CsvFile, of_other_separators_quotes_cases_and_comments_is_read_and_told)
{
  const auto notes = [&](const std::string &text)
  {
    Csv csv = open(text);
    std::string all;
    EXPECT_TRUE(csv.next());
    EXPECT_EQ(csv.integer("a"), 1) << text;
    EXPECT_EQ(csv.number("b"), 2.5) << text;
    EXPECT_FALSE(csv.next());
    for (const std::string &note : csv.notes())
      all += note + "; ";
    return all;
  };
  EXPECT_EQ(notes("a,b\n1,2.5\n"), "");
  EXPECT_EQ(notes("a;b\n1; 2.5\n"), "values are separated by ';'; ");
  EXPECT_EQ(notes("b\ta\n2.5\t1\n"), "values are separated by tabs; ");
  EXPECT_EQ(notes("  a   b\n 1  2.5 \n"), "values are separated by blanks; ");
  EXPECT_EQ(notes("\"a\",\"b\",c\n\"1\",\"2.5\",\"x, y\"\n"), "values are in quotes; ");
  EXPECT_EQ(notes("A,B\n1,2.5\n"), "names of columns are in upper case; ");
  EXPECT_EQ(notes("# mine\n\na,b\n// one\n1,2.5\n% end\n"), "3 comment lines are left out; ");
  EXPECT_EQ(notes("#mine\n# b a\n2.5 1\n"),
            "values are separated by blanks; a comment line names the columns; 1 comment line is "
            "left out; ");
  EXPECT_EQ(fault("A,a\n1,2\n").find(" has no column b in its first line 'A,a'"), 0u);
  EXPECT_EQ(fault("a;b\n1;2,5\n"),
            ", line 2: b = '2,5' is not a finite number; write decimal points, not commas");
}

TEST_F(CsvFile, tells_the_rounding_of_its_numbers_by_their_digits)
{
  const auto rounding = [&](const std::vector<std::string> &numbers, double number)
  {
    PrintedDigits digits;
    for (const std::string &one : numbers)
      digits.add(one);
    return digits.rounding(number);
  };
  EXPECT_NEAR(rounding({"0.250000", "-1.500000"}, 1.5), 5e-7, 1e-12); // so many decimals
  EXPECT_NEAR(rounding({"0.250000", "-1.500000"}, .001), 5e-7, 1e-12);
  EXPECT_NEAR(rounding({"0.010000"}, .01), 5e-7, 1e-12);
  EXPECT_NEAR(rounding({"448249.750"}, 448249.75), 5e-4, 1e-9);
  EXPECT_NEAR(rounding({"0.0123457", "12.3457"}, .0123457), 5e-8, 1e-12); // so many digits
  EXPECT_NEAR(rounding({"1.234567e-05", "5"}, 1.234567e-5), 5e-12, 1e-16);
  EXPECT_NEAR(rounding({".05", ".1"}, .05), 5e-8, 1e-12); // short numbers may be exact
}

TEST_F(CsvFile, holds_nodes)
{
  const auto read = [&](const std::string &text)
  {
    open(text, {});
    return read_nodes(file_);
  };
  EXPECT_EQ(read("y,label,x\n.5,a,1e-1\n\n-2,b,+3\n"),
            (std::vector<dealii::Point<2>>{{.1, .5}, {3, -2}}));
  EXPECT_EQ(error_of([&] { read("x,z\n1,2\n"); }),
            " has no column y in its first line 'x,z'; name the columns there: x,y");
  EXPECT_EQ(error_of([&] { read("x,y\n1\n"); }),
            ", line 2: y = '' is not a finite number; mend or take out the line");
}

TEST_F(CsvFile, of_numbers_alone_is_read_row_by_row)
{
  const auto read = [&](const std::string &text)
  {
    std::ofstream(file_, std::ios::binary) << text;
    return read_number_grid(file_);
  };
  const NumberGrid grid = read("\xEF\xBB\xBF"
                               "1, 2,\t-3e-1\r\n\r\n+4,.5,6\r\n\n");
  EXPECT_EQ(grid.n, (std::array<int, 2>{3, 2}));
  EXPECT_EQ(grid.values, (std::vector<double>{1, 2, -.3, 4, .5, 6}));
  EXPECT_EQ(read("7").values, std::vector<double>{7}); // without an end of its line
  const auto fault = [&](const std::string &text) { return error_of([&] { read(text); }); };
  EXPECT_EQ(fault("1,2\n\n1,2,3\n"),
            ", line 3: has 3 numbers, and the rows above have 2; give all rows as many");
  EXPECT_EQ(fault("1,2\n1\n"),
            ", line 2: has 1 numbers, and the rows above have 2; give all rows as many");
  for (const std::string bad : {"x", "nan", "inf", "1 2", "1;2", "1e999", "", "# 1"})
    EXPECT_EQ(fault("1,2\n1," + bad + "\n"),
              ", line 2: '" + bad +
                  "' is not a finite number; write numbers such as 0 or 0.5, separated by ','");
  EXPECT_EQ(fault("1,2\n,\n").find(", line 2: '' is not a finite"), 0u); // no blank line
  EXPECT_EQ(fault(" \n\n"), " has no numbers; write a row of them a line, separated by ','");
  EXPECT_EQ(fault(""), " has no numbers; write a row of them a line, separated by ','");
  std::filesystem::remove(file_);
  EXPECT_EQ(error_of([&] { read_number_grid(file_); }),
            " cannot be read; give the name of a file of numbers separated by ',', a row a line");
}
