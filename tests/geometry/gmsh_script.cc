#include "geometry/gmsh_script.h"

#include "meshes.h"
#include "tests/text_folder.h"

#include <filesystem>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  /// Files that vanish with the test.
  class GmshScript : public testing::Test, protected tests::TextFolder
  {
  protected:
    GmshScript() : TextFolder("script") {}

    std::string fault(const std::string &text) const
    {
      return error_of([&] { check_script(write("a.geo", text)); });
    }
  };
} // namespace

TEST_F(GmshScript, that_only_draws_is_good)
{
  EXPECT_EQ(fault("// Save, Print and SystemCall in words\n/* Merge *\n Plugin **/ a = \"it's\";\n"
                  "Point(1) = {0, 0, 0, .1}; If (1 > 0) b = 'Include'; EndIf\n"
                  "Printf(\"%g > %g\", a, 1 > 2); saved = 1; SaveAll = 2;\r\n"
                  "Mesh.SaveAll = 0; Mesh.SavePrint = 1;"),
            "no error");
}

TEST_F(GmshScript, tells_which_files_it_reads)
{
  const std::string part = write("part.geo", "Field[1] = PostView; Field[1].FileName = 'f.pos';\n"),
                    data = write("f.pos", "x"), mesh = write("b.msh", "$MeshFormat\n"),
                    script =
                        write("a.geo", "Include \"part.geo\"; Merge 'b.msh'; // Merge 'c.msh'\n"
                                       "Physical Surface(\"omega\") = {1};\n");
  EXPECT_EQ(files_of_script(script), (std::vector<std::string>{script, part, data, mesh}));
}

TEST_F(GmshScript, that_starts_programs_is_refused_with_its_line)
{
  for (const std::string command :
       {"SystemCall \"true\";", "System 'true';", "NonBlockingSystemCall \"true\";",
        "OnelabRun(\"a\", \"true\");", "Field[1] = ExternalProcess;",
        "Field[1].CommandLine = \"true\";", "Solver.Executable0 = \"true\";"})
  {
    const std::string found = fault("a = 1;\n/* x\n */ " + command);
    EXPECT_TRUE(says(found, "a.geo', line 3: ")) << found;
    EXPECT_TRUE(says(found, "would start a program, which meshes may not; take the command out"));
  }
}

TEST_F(GmshScript, that_writes_files_is_refused)
{
  for (const std::string command :
       {"Save \"x.msh\";", "Print 'x.png';", "CreateDir \"x\";", "Plugin(MathEval).Run;",
        "Save StrCat(\"x\", \".msh\");", "Save View[0] \"x\";"})
    EXPECT_TRUE(says(fault(command), "line 1: " + command.substr(0, command.find_first_of(" (")) +
                                         " would write a file or more, which meshes may not"))
        << fault(command);
  for (const std::string command :
       {"Printf(\"a\") > \"x\";", "Printf(\"%g\", (1)) >> \"x\";", "Error(\"a\") > \"x\";"})
    EXPECT_TRUE(says(fault(command), "Printf writes a file ('>')")) << command;
}

// gmsh's scanner does not know quotes where it skips a branch: it goes on behind EndIf in them
TEST_F(GmshScript, cannot_hide_commands_where_gmsh_skips)
{
  EXPECT_TRUE(says(fault("If(0)\n a = \" EndIf ; SystemCall \"true\"; b=\"c\";"),
                   "line 2: a text in quotes holds the command EndIf; take it out, it could hide"));
  EXPECT_TRUE(says(fault("a = \"xElse9\";"), "holds the command Else"));
  EXPECT_TRUE(
      says(fault("a = \"/*\"; // */ EndIf SystemCall 'true';"), "holds the mark of a comment /*"));
  EXPECT_TRUE(says(fault("a = \"\n SystemCall 'true'; \";"),
                   "line 1: a text in quotes does not end on its line; close the quotes"));
  EXPECT_TRUE(says(fault("a = \"" + std::string(1023, 'x') + "SystemCall 'true';\";"),
                   "is longer than 1000 characters"));
  EXPECT_TRUE(says(fault("a = \"x"), "the file ends within a text in quotes"));
  EXPECT_TRUE(says(fault("/* x"), "the file ends within a comment; close it by */"));
  EXPECT_TRUE(says(fault(std::string("// \0 SystemCall 'true';", 23)),
                   "has the control character 0; write plain text, not compressed"));
  EXPECT_TRUE(says(fault("\x1f\x8b\x08packed"), "control character 31"));
}

TEST_F(GmshScript, is_followed_into_what_it_reads)
{
  std::filesystem::create_directory(path() / "parts");
  write("parts/bad.txt", "a = 1;\nSystemCall 'true';\n");
  write("parts/next.geo", "\nInclude \"bad.txt\";\n");
  EXPECT_TRUE(says(fault("Merge \"parts/next.geo\";"), "bad.txt', line 2: SystemCall"));
  EXPECT_TRUE(
      says(fault("MergeWithBoundingBox('parts/bad.txt');"), "bad.txt', line 2: SystemCall"));
  write("parts/mesh.msh", "$MeshFormat\n SystemCall \n"); // read as a mesh, whatever is in it
  EXPECT_EQ(fault("Merge \"parts/mesh.msh\";"), "no error");
  EXPECT_TRUE(says(fault("a = 1;\nMerge \"nowhere.geo\";"),
                   "line 2: 'nowhere.geo' is not there to be read; check its name and folder"));
  EXPECT_TRUE(says(fault("\nInclude \"a.geo\";"), "line 2: 'a.geo' is being read already"));
  for (const std::string name : {"StrCat(\"a\", \"b\")", "name", "(name)", "Str(\"x\")"})
    EXPECT_TRUE(says(fault("Include " + name + ";"), "Include with a name that is not written out"))
        << name;
}

TEST_F(GmshScript, is_read_with_all_files_that_it_includes)
{
  write("b.geo", "b = 1;");
  EXPECT_EQ(fault("Include 'b.geo';"), "no error");
  write("b.geo", "b = 1;\nSave 'x.msh';");
  EXPECT_TRUE(says(fault("Include 'b.geo';"), "b.geo', line 2: Save would write a file"));
}
