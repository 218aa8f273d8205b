#include "ballbar/formats/sessions/runs_toml.hpp"

#include <gtest/gtest.h>

#include <string>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

TEST(RunsToml, ListsTheRunsInTheirOrder) {
  const RunsOfMachine list = read_run_list(
      "format = \"ballbar-runs 1\"\ntitle = \"spindle 2\"\n[[run]]\nfile = \"monday.csv\"\n"
      "[[run]]\nfile = \"tuesday\"\nstarts = \"warm\"\n[[run]]\nfile = \"c.csv\"\nstarts = \"rest\"\n",
      "machine.toml");
  EXPECT_EQ(list.title, "spindle 2");
  ASSERT_EQ(list.runs.size(), 3U);
  EXPECT_EQ(list.runs[0].file, "monday.csv");
  EXPECT_FALSE(list.runs[0].start);
  EXPECT_EQ(list.runs[1].start, RunStart::warm);
  EXPECT_EQ(list.runs[2].start, RunStart::rest);
}

struct Bad {
  const char* text;
  const char* message;
};

TEST(RunsToml, SaysWhatIsWrongAndWhere) {
  const std::string head = "format = \"ballbar-runs 1\"\n";
  const Bad cases[] = {
      {"", "m:1:1: expected at least one [[run]], found none."},
      {"title = 3\n[[run]]\nfile = \"a\"\n", "m:2:9: expected a text in quotes for title, found the integer 3."},
      {"[[run]]\nstarts = \"warm\"\n", "m:2:1: expected the key file in [[run]] 1, found none."},
      {"[[run]]\nfile = \"/etc/passwd\"\n",
       "m:3:8: expected a path to a file inside the list's folder for file, found \"/etc/passwd\"."},
      {"[[run]]\nfile = \"a\"\nstarts = \"hot\"\n",
       "m:4:10: expected one of \"rest\", \"warm\" for starts, found the text \"hot\"."},
      {"[[run]]\nfiel = \"a\"\n",
       "m:3:1: expected one of the keys file, starts in [[run]] 1, found \"fiel\"; the nearest is file."},
  };
  for (const Bad& bad : cases) {
    try {
      read_run_list(head + bad.text, "m");
      ADD_FAILURE() << bad.text;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), bad.message);
    }
  }
}

}  // namespace
}  // namespace ballbar
