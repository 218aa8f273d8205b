// Squareness and scales of a machine as `history --json` prints them, with files in place of places.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/history/machine_geometry.hpp"
#include "history/test_files.hpp"

namespace ballbar {

struct SquarenessResult {
  PlaneSquareness squareness;
  std::vector<std::string> files;
};

template <>
struct ResultType<SquarenessResult> {
  using Of = const SquarenessResult&;
  static constexpr std::string_view name = "PlaneSquareness";
  static constexpr std::string_view meaning = "How far a plane is out of square.";
  static constexpr std::tuple fields{
      Field{"plane", [](Of of) { return of.squareness.plane; }, ""},
      Field{"value", [](Of of) { return of.squareness.value; }, "um/m"},
      Field{"sigma", [](Of of) { return of.squareness.sigma; }, ""},
      Field{"p_value", [](Of of) { return of.squareness.p_value; }, "of tests that differ as much by chance"},
      Field{"files", &SquarenessResult::files, "that it is from"}};
};

constexpr auto letter_of(auto member) {
  return [member](const auto& of) { return std::string(1, "XYZ"[of.*member]); };
}

template <>
struct ResultType<AxisScale> {
  static constexpr std::string_view name = "AxisScale";
  static constexpr std::string_view meaning = "The scale of an axis.";
  static constexpr std::tuple fields{
      Field{"axis", letter_of(&AxisScale::axis), "X, Y, Z"}, Field{"value", &AxisScale::value_ppm, "um/m"},
      Field{"sigma", &AxisScale::sigma_ppm, ""}, Field{"planes", &AxisScale::planes, "that it is measured in"}};
};

struct PullResult {
  ScalePull pull;
  std::string file;
  Plane plane = Plane::XY;
};

template <>
struct ResultType<PullResult> {
  static constexpr std::string_view name = "ScalePull";
  static constexpr std::string_view meaning = "The scale of an axis in one test.";
  static constexpr std::tuple pulled{
      Field{"axis", letter_of(&ScalePull::axis), "X, Y, Z"}, Field{"value", &ScalePull::value_ppm, "um/m"},
      Field{"sigma", &ScalePull::sigma_ppm, ""},
      Field{"pull", &ScalePull::pull, "what is left over its sigma; null: only this test tells the axis"}};
  static constexpr std::tuple fields =
      std::tuple_cat(std::tuple{Field{"file", &PullResult::file, ""}, Field{"plane", &PullResult::plane, ""}},
                     fields_through(&PullResult::pull, pulled));
};

struct AgreementOfTests {
  double chi2 = 0.0;
  std::size_t degrees = 0;
  double p_value = 0.0, scatter_ppm = 0.0;
  std::vector<PullResult> pulls;
};

template <>
struct ResultType<AgreementOfTests> {
  static constexpr std::string_view name = "AgreementOfTests";
  static constexpr std::string_view meaning = "Whether tests of several planes agree.";
  static constexpr std::tuple fields{
      Field{"chi2", &AgreementOfTests::chi2, ""},
      Field{"degrees", &AgreementOfTests::degrees, "of freedom; 0: nothing to compare"},
      Field{"p_value", &AgreementOfTests::p_value, ""},
      Field{"scatter_um_per_m", &AgreementOfTests::scatter_ppm, "of each scale beyond its sigma, where they disagree"},
      Field{"pulls", &AgreementOfTests::pulls, "a row a scale and test"}};
};

struct GeometryResult {
  bool within_a_day = true;
  std::vector<SquarenessResult> squareness;
  std::vector<AxisScale> scales;
  AgreementOfTests agreement;
};

template <>
struct ResultType<GeometryResult> {
  static constexpr std::string_view name = "MachineGeometry";
  static constexpr std::string_view meaning = "Squareness and scales of a machine.";
  static constexpr std::tuple fields{Field{"within_a_day", &GeometryResult::within_a_day, "whether all tests are"},
                                     Field{"out_of_square_um_per_m", &GeometryResult::squareness, "a row a plane"},
                                     Field{"scales_um_per_m", &GeometryResult::scales, "a row an axis"},
                                     Field{"agreement", &GeometryResult::agreement, "of the tests"}};
};

GeometryResult result_of(const MachineGeometry& geometry, const std::vector<MachineTest>& tests);

}  // namespace ballbar
