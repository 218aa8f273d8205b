#include "report/report_inside.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scratch_folder.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

TEST(ReportInside, FilesHaveThePathsBelowTheirCommonFolder) {
  const ScratchFolder scratch;
  const fs::path root = scratch.path() / "machine";
  scratch.write("machine/test/a.csv", "f");
  scratch.write("machine/test/b.csv", "fo");
  scratch.write("machine/model.toml", "foob");
  const Json inside = files_inside(
      {root / "test" / "b.csv", root / "test" / ".." / "test" / "a.csv", root / "model.toml", root / "test" / "a.csv"},
      {(root / "test").string() + "/"}, (root / "model.toml").string());
  EXPECT_EQ(inside["files"], Json::parse(R"([{"path": "model.toml", "base64": "Zm9vYg=="},
    {"path": "test/a.csv", "base64": "Zg=="}, {"path": "test/b.csv", "base64": "Zm8="}])"));
  EXPECT_EQ(inside["data"], Json::parse(R"(["test"])"));
  EXPECT_EQ(inside["model"], "model.toml");
}

TEST(ReportInside, AnyBytesAreKept) {
  const ScratchFolder scratch;
  const fs::path file = scratch.write("bytes.b5r", std::string("\0\xff\x10\x80", 4) + "\xfb\xef\xbe");
  const Json inside = files_inside({file}, {file.string()}, "");
  EXPECT_EQ(inside["files"][0]["base64"], "AP8QgPvvvg==");
  EXPECT_EQ(inside["data"][0], "bytes.b5r");
  EXPECT_FALSE(inside.contains("model"));
}

TEST(ReportInside, TooMuchIsLeftOut) {
  const ScratchFolder scratch;
  scratch.write("a.csv", std::string(kMostInside, '1'));
  EXPECT_FALSE(files_inside({scratch.path() / "a.csv"}, {"a.csv"}, "").is_null());
  scratch.write("b.csv", "1");
  EXPECT_TRUE(files_inside({scratch.path() / "a.csv", scratch.path() / "b.csv"}, {"a.csv"}, "").is_null());
}

TEST(ReportInside, NothingOfNoFile) { EXPECT_TRUE(files_inside({"absent.csv"}, {"absent.csv"}, "").is_null()); }

}  // namespace
}  // namespace ballbar
