#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "bad_text.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

TEST(session_plan, two_arcs) {
  const SessionPlan plan = read_session_plan(good_text("session"), "file");
  EXPECT_EQ(plan.method, Method::two_arcs);
  EXPECT_EQ(plan.title, "warm-up");
  EXPECT_EQ(plan.nominal_length_mm, 100.0);
  EXPECT_TRUE(plan.spindle_above);
  ASSERT_EQ(plan.tests.size(), 2u);
  EXPECT_EQ(plan.tests[1].elapsed_s, 600.0);
  EXPECT_EQ(plan.tests[1].c_arc, "01-c.csv");
  EXPECT_EQ(plan.tests[1].a_arc, "01-a.csv");
  EXPECT_EQ(plan.signal_files, std::vector<std::string>{"temperatures.csv"});
  EXPECT_EQ(plan.five_probe_file, "five-probe.csv");
  EXPECT_FALSE(plan.bar_expansion_ppm_per_K);
  EXPECT_FALSE(plan.ball.from_plane_1_mm);
  EXPECT_FALSE(plan.ball.sigma_mm);
}

TEST(session_plan, expansion_of_the_bar_and_place_of_the_ball) {
  std::string text = changed("session", "file = \"five-probe.csv\"",
                             "file = \"five-probe.csv\"\nball_from_plane_1_mm = -12\nball_sigma_mm = 0.25");
  text.replace(text.find("[[test]]"), 0, "expansion_ppm_per_K = 11.7\n");
  const SessionPlan plan = read_session_plan(text, "file");
  EXPECT_EQ(plan.bar_expansion_ppm_per_K, 11.7);
  EXPECT_EQ(plan.ball.from_plane_1_mm, -12.0);
  EXPECT_EQ(plan.ball.sigma_mm, 0.25);
}

TEST(session_plan, a_path_that_stays_inside_may_use_dots) {
  EXPECT_EQ(read_session_plan(changed("session", "01-c.csv", "./a/../01-c.csv"), "file").tests[1].c_arc,
            "./a/../01-c.csv");
  EXPECT_EQ(read_session_plan(changed("session", "01-c.csv", "..c.csv"), "file").tests[1].c_arc, "..c.csv");
}

TEST(session_plan, texts_and_comments_hold_any_character) {
  const SessionPlan plan =
      read_session_plan(changed("session", "\"warm-up\"", "\"\"\"\n[# \\\" \u00E9 \"\"\" # [\u00E9"), "file");
  EXPECT_EQ(plan.title, "[# \" \u00E9 ");
  const SessionPlan literal = read_session_plan(changed("session", "\"warm-up\"", "'\u00E9 \\'  # it's"), "file");
  EXPECT_EQ(literal.title, "\u00E9 \\");
}

TEST(session_plan, written_and_read_again_is_the_same) {
  const bool passed = rc::check([] {
    SessionPlan plan;
    plan.method = *rc::gen::element(Method::two_arcs, Method::spindle_rotation, Method::circles);
    plan.title = *rc::gen::element<std::string>("", "a \"b\" \\ c\n\x7F", "\xE6\xB8\xA9");
    plan.nominal_length_mm = *rc::gen::inRange(1, 10000) / 7.0;
    plan.spindle_above = *rc::gen::arbitrary<bool>();
    double elapsed_s = 0.0;
    for (int i = *rc::gen::inRange(1, 20); i > 0; --i) {
      SessionPlan::Test test;
      test.elapsed_s = elapsed_s += *rc::gen::inRange(1, 1000) / 3.0;
      const std::string name = *rc::gen::element<std::string>("a.csv", "b/c d.csv", "\\\"q.csv");
      if (plan.method == Method::two_arcs) test.c_arc = test.a_arc = name;
      if (plan.method == Method::circles) test.circle = name;
      if (plan.method == Method::spindle_rotation) {
        test.rotation = name;
        if (*rc::gen::arbitrary<bool>()) {
          test.axial = name;
        } else {
          test.axial_length_mm = 99.9874;
        }
      }
      plan.tests.push_back(test);
    }
    if (*rc::gen::arbitrary<bool>()) plan.signal_files = {"t.csv", "u \"v\".csv"};
    if (*rc::gen::arbitrary<bool>()) plan.bar_expansion_ppm_per_K = *rc::gen::inRange(-300, 300) / 7.0;
    if (*rc::gen::arbitrary<bool>()) {
      plan.five_probe_file = "p.csv";
      if (*rc::gen::arbitrary<bool>()) plan.ball.from_plane_1_mm = *rc::gen::inRange(-2000, 2000) / 7.0;
      if (*rc::gen::arbitrary<bool>()) plan.ball.sigma_mm = *rc::gen::inRange(1, 100) / 7.0;
    }
    const SessionPlan again = read_session_plan(write_session_plan(plan), "file");
    RC_ASSERT(again.method == plan.method);
    RC_ASSERT(again.title == plan.title);
    RC_ASSERT(again.nominal_length_mm == plan.nominal_length_mm);
    RC_ASSERT(again.spindle_above == plan.spindle_above);
    RC_ASSERT(again.signal_files == plan.signal_files);
    RC_ASSERT(again.five_probe_file == plan.five_probe_file);
    RC_ASSERT(again.bar_expansion_ppm_per_K == plan.bar_expansion_ppm_per_K);
    RC_ASSERT(again.ball.from_plane_1_mm == plan.ball.from_plane_1_mm);
    RC_ASSERT(again.ball.sigma_mm == plan.ball.sigma_mm);
    RC_ASSERT(again.tests.size() == plan.tests.size());
    for (std::size_t i = 0; i < plan.tests.size(); ++i) {
      RC_ASSERT(again.tests[i].elapsed_s == plan.tests[i].elapsed_s);
      RC_ASSERT(again.tests[i].c_arc == plan.tests[i].c_arc);
      RC_ASSERT(again.tests[i].a_arc == plan.tests[i].a_arc);
      RC_ASSERT(again.tests[i].rotation == plan.tests[i].rotation);
      RC_ASSERT(again.tests[i].axial == plan.tests[i].axial);
      RC_ASSERT(again.tests[i].circle == plan.tests[i].circle);
      RC_ASSERT(again.tests[i].axial_length_mm == plan.tests[i].axial_length_mm);
    }
  });
  EXPECT_TRUE(passed);
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string arc(std::string_view plane) {
  return replaced(changed("log", "linear_axes", "rotary_axis"), "\"XY\"", "\"" + std::string(plane) + "\"");
}

// good_text("session") with its files.
fs::path write_two_arcs(const ScratchFolder& folder) {
  for (const std::string_view name : {"00-c.csv", "01-c.csv"}) folder.write(name, arc("XY"));
  for (const std::string_view name : {"00-a.csv", "01-a.csv"}) folder.write(name, arc("YZ"));
  return folder.write("session.toml", good_text("session"));
}

TEST(session, two_arcs) {
  const ScratchFolder folder;
  const fs::path file = write_two_arcs(folder);
  for (const fs::path& path : {file, folder.path()}) {
    const SessionFiles files = open_session(path);
    EXPECT_EQ(files.session.method, Method::two_arcs);
    ASSERT_EQ(files.session.tests.size(), 2u);
    EXPECT_EQ(files.session.tests[1].elapsed_s, 600.0);
    EXPECT_EQ(files.session.tests[1].name, "01-c.csv");
    EXPECT_EQ(files.session.tests[1].c_arc->length_mm.size(), 3u);
    EXPECT_EQ(files.session.tests[1].a_arc->plane, Plane::YZ);
    EXPECT_EQ(paths_of(files.signals), std::vector<fs::path>{folder.path() / "temperatures.csv"});
    EXPECT_EQ(files.five_probe.value().path(), folder.path() / "five-probe.csv");
  }
}

TEST(session, keeps_what_the_plan_states_and_lists_its_files) {
  const ScratchFolder folder;
  write_two_arcs(folder);
  std::string text = changed("session", "file = \"five-probe.csv\"",
                             "file = \"five-probe.csv\"\nball_from_plane_1_mm = 25\nball_sigma_mm = 0.5");
  text.replace(text.find("[[test]]"), 0, "expansion_ppm_per_K = 11.7\n");
  const SessionFiles files = open_session(folder.write("session.toml", text));
  EXPECT_EQ(files.session.bar_expansion_ppm_per_K, 11.7);
  EXPECT_EQ(files.ball.from_plane_1_mm, 25.0);
  EXPECT_EQ(files.ball.sigma_mm, 0.5);
  std::vector<std::string> names;
  for (const fs::path& path : files.files) names.push_back(path.lexically_relative(folder.path()).string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"00-a.csv", "00-c.csv", "01-a.csv", "01-c.csv", "five-probe.csv",
                                             "session.toml", "temperatures.csv"}));
}

TEST(session, spindle_rotation) {
  const ScratchFolder folder;
  folder.write("00-r.csv", changed("log", "linear_axes", "spindle"));
  folder.write("00-z.csv", good_text("axial"));
  const SessionFiles files = open_session(folder.write("session.toml", good_text("rotation")));
  EXPECT_EQ(files.session.method, Method::spindle_rotation);
  EXPECT_EQ(files.session.tests[0].rotation->motion, Motion::spindle);
  EXPECT_EQ(files.session.tests[0].axial->length_mm.size(), 2u);
}

TEST(session, recordings_that_do_not_fit_the_method_are_named) {
  const ScratchFolder folder;
  const fs::path file = write_two_arcs(folder);
  const auto with = [&](std::string_view name, std::string_view bytes) {
    write_two_arcs(folder);
    folder.write(name, bytes);
    return complaint(folder, [&] { open_session(file); });
  };
  EXPECT_EQ(with("00-c.csv", good_text("log")),
            "DIR/00-c.csv: expected a circle in plane XY driven by rotary_axis for c_arc, found a circle in plane XY "
            "driven by linear_axes.");
  EXPECT_EQ(with("01-a.csv", arc("ZX")),
            "DIR/01-a.csv: expected a circle in plane YZ driven by rotary_axis for a_arc, found a circle in plane ZX "
            "driven by rotary_axis.");
  EXPECT_EQ(with("01-a.csv", good_text("axial")),
            "DIR/01-a.csv: expected a circle in plane YZ driven by rotary_axis for a_arc, found an axial recording.");
  EXPECT_EQ(with("01-c.csv", replaced(arc("XY"), "nominal_length_mm = 100.0", "nominal_length_mm = 105")),
            "DIR/01-c.csv: expected the session's nominal length 100 mm, found 105 mm.");
  EXPECT_EQ(with("01-c.csv", "time_s\n").substr(0, 45), "DIR/01-c.csv:1:1: expected a recording, which");
  const std::string run = good_text("b5r").substr(good_text("b5r").find("    <BALLBAR_RUN>"));
  const std::string two_runs =
      changed("b5r", "  <RUN_RESULTS>\n", "  <RUN_RESULTS>\n" + run.substr(0, run.find("  </RUN_RESULTS>")));
  EXPECT_EQ(with("00-c.csv", two_runs), "DIR/00-c.csv: expected one recording, found 2 runs.");
  fs::remove(folder.path() / "00-a.csv");
  folder.write("00-c.csv", arc("XY"));
  EXPECT_EQ(complaint(folder, [&] { open_session(file); }),
            "DIR/00-a.csv: expected a file, found nothing of that name.");
}

TEST(session, a_link_out_of_the_folder_is_refused) {
  const ScratchFolder outside;
  const fs::path elsewhere = outside.write("c.csv", arc("XY"));
  const ScratchFolder folder;
  const fs::path file = write_two_arcs(folder);
  fs::remove(folder.path() / "01-c.csv");
  fs::create_symlink(elsewhere, folder.path() / "01-c.csv");
  EXPECT_EQ(complaint(folder, [&] { open_session(file); }),
            "DIR/01-c.csv: expected a file inside the session's folder, found a link or path that leaves it.");
  fs::remove(folder.path() / "01-c.csv");
  fs::create_symlink("00-c.csv", folder.path() / "01-c.csv");
  EXPECT_NO_THROW(open_session(file));
}

TEST(session, relative_to_the_working_folder) {
  const ScratchFolder folder;
  write_two_arcs(folder);
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  EXPECT_NO_THROW(open_session("session.toml"));
  EXPECT_NO_THROW(open_session("."));
  fs::current_path(before);
}

TEST(session, folder_of_b5r_files_in_the_order_they_were_measured) {
  const ScratchFolder folder;
  folder.write("a.B5R", changed("b5r", "20200229-120001", "20200301-000001"));
  folder.write("b.b5r", good_text("b5r"));
  folder.write("notes.txt", "not a recording");
  const Session session = open_session(folder.path()).session;
  EXPECT_EQ(session.method, Method::circles);
  EXPECT_EQ(session.title, folder.path().filename().string());
  ASSERT_EQ(session.tests.size(), 2u);
  EXPECT_EQ(session.tests[0].name, "b.b5r");
  EXPECT_EQ(session.tests[0].elapsed_s, 0.0);
  EXPECT_EQ(session.tests[1].name, "a.B5R");
  EXPECT_EQ(session.tests[1].elapsed_s, 43200.0);
  EXPECT_EQ(session.tests[1].circles.size(), 1u);
}

TEST(session, folders_that_are_no_session) {
  const ScratchFolder folder;
  const auto opening = [&] { return complaint(folder, [&] { open_session(folder.path()); }); };
  EXPECT_EQ(opening(), "DIR: expected a folder with session.toml or recordings (.b5r, circles), found neither.");
  folder.write("a.b5r", good_text("b5r"));
  folder.write("b.b5r", good_text("b5r"));
  const std::string no_drift =
      "DIR: expected at least two tests of the same plane for a drift, found one of ZX. Use ballbar history DIR for "
      "squareness and scales. Omitted: DIR/b.b5r: ";
  EXPECT_EQ(opening(), no_drift +
                           "expected tests that started at different times, found the same DATE_STARTED as "
                           "a.b5r has.");
  folder.write("b.b5r", changed("b5r", "  <DATE_STARTED>20200229-120001</DATE_STARTED>\n", ""));
  EXPECT_EQ(opening(),
            no_drift +
                "expected DATE_STARTED, the time of this test, found none that can be read. State the interval "
                "of the tests in order of their names, as in --every 30min.");
  folder.write("b.b5r", replaced(changed("b5r", "20200229-120001", "20200301-000001"), "<NOMINAL_LENGTH>100",
                                 "<NOMINAL_LENGTH>50"));
  EXPECT_EQ(opening(),
            "DIR: expected tests of one nominal length for a drift, found 100 mm in a.b5r and 50 mm in b.b5r. Use "
            "ballbar history DIR for different lengths.");
}

// A test of results alone, whose run stores its circle.
std::string stored_alone(std::string_view started, std::string_view centre_a_mm) {
  std::string text = changed("b5r", "20200229-120001", std::string(started));
  const std::size_t readings = text.find("      <READINGS>");
  text.erase(readings, text.find('\n', readings) + 1 - readings);
  text.insert(text.find("      <FEATURE NAME=\"AF_BEST_RADIUS\""),
              "      <FEATURE NAME=\"AF_CENTRE_OFFSET_A\" DT=\"UT_LENGTH_MM\">" + std::string(centre_a_mm) +
                  "</FEATURE>\n      <FEATURE NAME=\"AF_CENTRE_OFFSET_B\" DT=\"UT_LENGTH_MM\">-0.003</FEATURE>\n");
  return text;
}

TEST(session, of_a_folder_does_without_what_cannot_be_read) {
  const ScratchFolder folder;
  folder.write("a.b5r", good_text("b5r"));
  folder.write("b.b5r", good_text("b5r").substr(0, 300));
  folder.write("c.b5r", stored_alone("20200301-000001", "0.0125"));
  const SessionFiles files = open_session(folder.path());
  ASSERT_EQ(files.session.tests.size(), 2u);
  ASSERT_EQ(files.skipped.size(), 1u);
  EXPECT_EQ(files.skipped[0].file, (folder.path() / "b.b5r").string());
  EXPECT_TRUE(files.session.tests[0].stored.empty());
  ASSERT_EQ(files.session.tests[1].stored.size(), 1u);
  EXPECT_NEAR(files.session.tests[1].stored[0].centre_a_um, 12.5, 1e-9);
}

TEST(session, stored_circles_give_a_drift_whose_sigma_is_not_known) {
  const ScratchFolder folder;
  folder.write("a.b5r", stored_alone("20200229-120001", "0.010"));
  folder.write("b.b5r", stored_alone("20200301-000001", "0.0125"));
  const DriftSeries drift = drift_of(open_session(folder.path()).session);
  // The plane ZX: its first axis is Z.
  ASSERT_TRUE(drift.points[1].z && drift.points[1].x);
  EXPECT_NEAR(drift.points[1].z->value_um, 2.5, 1e-9);
  EXPECT_NEAR(drift.points[1].x->value_um, 0.0, 1e-9);
  EXPECT_TRUE(std::isnan(drift.points[1].z->sigma_um));
}

TEST(session, a_folder_of_one_test_a_plane_has_no_drift) {
  const ScratchFolder folder;
  const auto opening = [&] { return complaint(folder, [&] { open_session(folder.path()); }); };
  folder.write("a.b5r", good_text("b5r"));
  EXPECT_EQ(
      opening(),
      "DIR: expected at least two tests of the same plane for a drift, found one of ZX. Use ballbar history DIR for "
      "squareness and scales.");
  folder.write("b.b5r", changed("b5r", "20200229-120001", "20200301-000001"));
  EXPECT_NO_THROW(open_session(folder.path()));
}

TEST(session, files_that_are_no_session) {
  const ScratchFolder folder;
  const auto opening = [&](std::string_view bytes) {
    const fs::path file = folder.write("f", bytes);
    return complaint(folder, [&] { open_session(file); });
  };
  const std::string expected =
      "DIR/f:1:1: expected a session (a folder or a file with format = \"ballbar-session 1\"), found ";
  EXPECT_EQ(opening(good_text("b5r")), expected + "XML, such as a .b5r file.");
  EXPECT_EQ(opening(good_text("log")), expected + "a ballbar log.");
  EXPECT_EQ(opening(good_text("series")), expected + "a series of columns over time.");
  EXPECT_EQ(opening(""), expected + "an empty file.");
  EXPECT_EQ(opening("title = 1\n"), "DIR/f:1:1: expected the key format, found none.");
  EXPECT_EQ(complaint(folder, [&] { open_session(folder.path() / "none"); }),
            "DIR/none: expected a file, found nothing of that name.");
}

}  // namespace
}  // namespace ballbar
