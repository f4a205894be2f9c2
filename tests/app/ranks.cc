// The command on several ranks: none waits for another, and one of them speaks.
#include "command.h"

namespace
{
  using namespace plumbline::app;

  std::size_t count(const std::string &text, const std::string &part)
  {
    std::size_t n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++n;
    return n;
  }

  std::string small_scene(const std::string &mesh)
  {
    return write("ranks_" + mesh + ".prm",
                 "subsection Domain\n set mesh = " + mesh +
                     "\nend\nsubsection Problem\n set solution = x^2 + y^2\nend\n"
                     "subsection Methods\n set names = FA, Q1\nend\n"
                     "subsection Study\n set h = 0.1, 0.05, 0.025\nend\n");
  }
} // namespace

TEST(Ranks, share_methods_and_levels_on_lattices_within_a_budget)
{
  const fs::path folder = temporary("ranks");
  const std::string scene = small_scene("lattice") + " --threads 1 -o " + folder.string();
  const Outcome outcome = run_on_two_ranks("run " + scene + " --budget 0.002");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("note: "), std::string::npos) << outcome.err;
  expect_found(read(folder / "results.json"),
               "\"work of ranks\": \"methods and levels are distributed: one rank computes each");
  fs::remove_all(folder);
}

TEST(Ranks, repeat_what_is_compared_with_own_finest_levels_and_say_so)
{
  const fs::path folder = temporary("ranks");
  const Outcome outcome = run_on_two_ranks(
      "run " + small_scene("lattice") +
      " --set 'Study/decisive error=averages L2 | own finest level' --threads 1 -o " +
      folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(count(outcome.err, "note: each of the 2 ranks repeats all of the work, because each "
                               "method is compared with its own finest level"),
            1u)
      << outcome.err;
  expect_found(read(folder / "results.json"), "\"work of ranks\": \"repeated by each");
  fs::remove_all(folder);
}

TEST(Ranks, share_meshes_without_a_word)
{
  const fs::path folder = temporary("ranks");
  const Outcome outcome = run_on_two_ranks("run " + small_scene("squares") +
                                           " --threads 1 --levels 2 --quiet -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(read(folder / "results.json").find("work of ranks"), std::string::npos);
  fs::remove_all(folder);
}

// Meshes in space are distributed in no other way.
TEST(Ranks, share_methods_and_levels_on_meshes_in_space)
{
  const fs::path folder = temporary("ranks");
  const std::string ball = std::string(PLUMBLINE_SCENES) +
                           "/three_d/ball.prm --levels 1 --methods FA,P1 --threads 1 "
                           "--set Expected/verdicts= --set Expected/rates= -o " +
                           folder.string();
  EXPECT_EQ(run("run " + ball + " --quiet").exit_code, 0);
  expect_found(read(folder / "results.json"), "entries exact to round-off");
  EXPECT_EQ(read(folder / "results.json").find("work of ranks"), std::string::npos);
  fs::remove_all(folder);
  EXPECT_EQ(run_on_two_ranks("run " + ball).exit_code, 0);
  expect_found(read(folder / "results.json"),
               "\"work of ranks\": \"methods and levels are distributed");
  fs::remove_all(folder);
}

// A constraint that is not finite in one slab is refused by all, at once.
TEST(Ranks, share_a_fault_of_one_slab)
{
  const std::string file =
      write("ranks_fault.prm", "subsection Domain\n set dimension = 3\n"
                               " set boxes = 0,0,0 : 1,1,1\nend\n"
                               "subsection Problem\n set load = 1\n"
                               " set constraint = x + 0*sqrt(1.49999 - z)\nend\n"
                               "subsection Methods\n set names = FA\nend\n"
                               "subsection Study\n set regime = m\n set horizon = 1/2\n"
                               " set h = 1/8, 1/16\n set norms = averages L2\n set decisive error "
                               "= averages L2 | reference\nend\n"
                               "subsection Reference\n set method = Q1\nend\n");
  const fs::path folder = temporary("ranks");
  const Outcome outcome = run_on_two_ranks("run " + file + " --threads 1 -o " + folder.string());
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err.find("MPI_ABORT"), std::string::npos) << outcome.err;
  expect_found(outcome.err, "it must be a finite number in the domain and its collar");
  fs::remove_all(folder);
}

TEST(Ranks, share_boxes_in_space_and_say_which_methods_do_not)
{
  const fs::path folder = temporary("ranks");
  const std::string cube =
      write("ranks_cube.prm", "subsection Domain\n set dimension = 3\n"
                              " set boxes = 0,0,0 : 1,1,1\nend\n"
                              "subsection Problem\n set solution = x^2 + y*z\nend\n"
                              "subsection Methods\n set names = FA, Q1\nend\n"
                              "subsection Study\n set h = 1/4, 1/6\nend\n"
                              "subsection Output\n set fields = true\nend\n") +
      " --threads 1 --quiet -o " + folder.string();
  Outcome outcome = run_on_two_ranks("run " + cube);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  const std::string results = read(folder / "results.json");
  expect_found(results, "\"work of ranks\": \"distributed in slabs of cells along z\"");
  expect_found(results, " in slabs\"");
  outcome = run_on_two_ranks("run " + cube +
                             " --set 'Domain/boxes=0,0,0 : 1,1,1/2; 0,0,0 : 1/2,1,1' --levels 1");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  expect_found(read(folder / "results.json"),
               "\"work of ranks\": \"distributed in slabs of cells along z\"");
  // the energy norm is of one rank, so ranks share methods instead
  outcome = run_on_two_ranks("run " + cube + " --set Study/norms='nodal Linf, energy' --levels 1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(read(folder / "results.json"),
               "\"work of ranks\": \"methods and levels are distributed");
  outcome = run_on_two_ranks("run " + cube + " --methods Q1,Q2 --levels 1");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(count(outcome.err, "note: each of the 2 ranks repeats all of the work of Q2; Q1, DGQ0 "
                               "and rules on the nodes of the lattice are distributed"),
            1u)
      << outcome.err;
  expect_found(read(folder / "results.json"),
               "\"work of ranks\": \"repeated by each: Q2; others distributed in slabs");
  fs::remove_all(folder);
}

// Of ranks that share slabs, and of ranks that share methods and levels.
TEST(Ranks, end_together_where_one_of_them_is_interrupted)
{
  const std::string cube = write("ranks_cube.prm", "subsection Domain\n set dimension = 3\n"
                                                   " set boxes = 0,0,0 : 1,1,1\nend\n"
                                                   "subsection Problem\n set solution = x^2 + y*z\n"
                                                   "end\nsubsection Methods\n set names = Q1\nend\n"
                                                   "subsection Study\n set h = 1/8, 1/64, 1/96\n"
                                                   "end\n"),
                    square = small_scene("lattice") +
                             " --methods DGQ1,DGQ2,DGQ3,Q2,Q3 --set 'Study/h=.05, .02, .01'";
  for (const std::string &scene : {cube, square})
  {
    const fs::path folder = temporary("ranks_interrupted"), err = temporary("ranks_err");
    const std::string ranks =
        write("ranks.sh", "if test $OMPI_COMM_WORLD_RANK = 1\nthen (until test -s " +
                              (folder / "results.jsonl").string() +
                              "; do sleep 0.1; done; kill -INT $$) &\nfi\n"
                              "exec " PLUMBLINE_COMMAND " run " +
                              scene + " --threads 1 -o " + folder.string());
    const int status = std::system(("timeout 60 " PLUMBLINE_MPIRUN " --allow-run-as-root "
                                    "--oversubscribe --mca mpi_yield_when_idle 1 -np 2 sh " +
                                    ranks + " >/dev/null 2>" + err.string())
                                       .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 130) << read(err);
    expect_found(read(err), "interrupted: what is finished is in '" + folder.string());
    EXPECT_EQ(run("report " + folder.string()).exit_code, 0);
    const std::string results = read(folder / "results.json");
    expect_found(results, "\"is_complete\": false");
    EXPECT_GE(count(results, "\"peak_bytes\""), 1u);
    EXPECT_LE(count(results, "\"peak_bytes\""), 7u); // of 15 the first rank has 7 on the square
    for (const fs::path &file : {folder, err, fs::path(ranks)})
      fs::remove_all(file);
  }
}

TEST(Ranks, share_motions_in_space_and_say_which_methods_do_not)
{
  const fs::path folder = temporary("ranks");
  const std::string cube =
      write("ranks_motion.prm", "subsection Domain\n set dimension = 3\n"
                                " set boxes = 0,0,0 : 1,1,1\nend\n"
                                "subsection Problem\n set solution = x*y + z^2\nend\n"
                                "subsection Time\n set final time = 0.1\n set frames = 2\n"
                                " set initial velocity = x*z\nend\n"
                                "subsection Methods\n set names = FA, Q1\nend\n"
                                "subsection Study\n set h = 1/4\n set norms = nodal L2\n"
                                " set decisive error = nodal L2 | exact\nend\n") +
      " --threads 1 --quiet -o " + folder.string();
  Outcome outcome = run_on_two_ranks("run " + cube);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  expect_found(read(folder / "dynamics.json"),
               "\"work of ranks\": \"distributed in slabs of cells along z\"");
  std::size_t n_frames = 0;
  for (const auto &entry : fs::directory_iterator(folder / "frames"))
    n_frames += entry.path().extension() == ".vtu" ? 1 : 0;
  EXPECT_EQ(n_frames, 4u);
  fs::remove_all(folder);
  outcome = run_on_two_ranks("run " + cube + " --methods FA,Q2");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(count(outcome.err, "note: each of the 2 ranks repeats all of the work of Q2; "), 1u)
      << outcome.err;
  expect_found(read(folder / "dynamics.json"),
               "\"work of ranks\": \"repeated by each: Q2; others distributed in slabs");
  fs::remove_all(folder);
  EXPECT_EQ(run_on_two_ranks("run " + cube + " --methods Q2").exit_code, 0);
  expect_found(read(folder / "dynamics.json"),
               "\"work of ranks\": \"methods and levels are distributed");
  fs::remove_all(folder);
}

TEST(Ranks, are_told_the_memory_of_each_before_the_run)
{
  const fs::path folder = temporary("ranks");
  const std::string cube =
      "run " +
      write("ranks_estimate.prm", "subsection Domain\n set dimension = 3\n"
                                  " set boxes = 0,0,0 : 1,1,1\nend\n"
                                  "subsection Problem\n set solution = x*y + z^2\nend\n"
                                  "subsection Methods\n set names = FA, Q2\nend\n"
                                  "subsection Study\n set h = 1/4, 1/32\nend\n") +
      " --estimate -o " + folder.string();
  const Outcome shared = run_on_two_ranks(cube + " --levels 1");
  EXPECT_EQ(shared.exit_code, 0) << shared.err;
  EXPECT_EQ(count(shared.out, "estimated peak memory of each of 2 ranks"), 1u) << shared.out;
  EXPECT_EQ(count(shared.out, "(4 x 4 x 4 cells) on each of 2 ranks"), 1u) << shared.out; // FA
  EXPECT_EQ(count(shared.out, "(32 x 32 x 32 cells)"), 0u) << shared.out;
  EXPECT_EQ(count(shared.out, "predicted time and messages of each of 2 ranks"), 1u) << shared.out;
  EXPECT_EQ(count(shared.out, "CG iteration"), 1u) << shared.out; // of FA
  EXPECT_FALSE(fs::exists(folder));
  const Outcome many = run(cube + " --levels 1 --ranks 4");
  expect_found(many.out, "estimated peak memory of each of 4 ranks");
  expect_found(many.out, "predicted time and messages of each of 4 ranks");
  // ranks that are not started would share what this machine has; those that run have their part
  expect_found(many.out, "available to all ranks on this machine: ");
  EXPECT_EQ(count(shared.out, "all fit here"), 0u) << shared.out;
  const auto answers = [&](const std::string &ranks)
  { return count(run(cube + " --levels 1 --ranks " + ranks).out, " yes\n"); };
  EXPECT_EQ(answers("4"), 2u);       // FA and Q2
  EXPECT_LT(answers("1000000"), 2u); // Q2 takes 1.3 MB of each, 1.3 TB of all together
  const Outcome alone = run(cube);
  expect_found(alone.out,
               "time: predicted only where several ranks share the work on one box in slabs");
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(count(alone.out, "(32 x 32 x 32 cells)"), 2u) << alone.out;
  EXPECT_FALSE(fs::exists(folder));
}

TEST(Ranks, refuse_with_one_voice)
{
  const Outcome outcome =
      run_on_two_ranks("run " + small_scene("lattice") + " --set Study/h=0.3 --threads 1");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(count(outcome.err, "plumbline: scene "), 1u) << outcome.err;
}

TEST(Ranks, end_where_the_page_cannot_be_written)
{
  const fs::path folder = temporary("ranks");
  fs::create_directories(folder / "report.html"); // a folder in its place
  const Outcome outcome = run_on_two_ranks("run " + small_scene("squares") +
                                           " --threads 1 --levels 1 -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 2);
  expect_found(outcome.err,
               "output file '" + (folder / "report.html").string() + "' cannot be written");
  fs::remove_all(folder);
}
