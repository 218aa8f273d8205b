// What `compensate --from-picture --json` prints, and the part of a page that `--plot` draws.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "shaft_picture/shaft_picture.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<ThreeAreas> = ResultType{
    "ThreeAreas", "A hot, a middle and a cold area of a picture, by thresholds of its colours.",
    std::tuple{Field{"mean_degC", known(&ThreeAreas::mean_degC), "by the three areas"},
               Field{"otsu_mean_degC", &ThreeAreas::otsu_mean_degC, "the same by Otsu's thresholds alone"},
               Field{"hot_pixels", &ThreeAreas::hot, ""}, Field{"middle_pixels", &ThreeAreas::middle, ""},
               Field{"cold_pixels", &ThreeAreas::cold, ""}, Field{"hot_share", &ThreeAreas::hot_share, ""},
               Field{"middle_share", &ThreeAreas::middle_share, ""}, Field{"cold_share", &ThreeAreas::cold_share, ""},
               Field{"red_otsu", &ThreeAreas::red_otsu, "threshold"},
               Field{"red_triangle", &ThreeAreas::red_triangle, ""}, Field{"blue_otsu", &ThreeAreas::blue_otsu, ""},
               Field{"blue_triangle", &ThreeAreas::blue_triangle, ""}}};

inline constexpr auto kPictureStateOfImage =
    std::tuple{Field{"region",
                     [](const TemperatureImage& of) {
                       return std::vector{of.region.x, of.region.y, of.region.width, of.region.height};
                     },
                     "x, y, width, height, pixels"},
               Field{"pixels_used", &TemperatureImage::used, ""},
               Field{"pixels_off_scale", &TemperatureImage::off_scale, ""},
               Field{"pixels_contrasting", &TemperatureImage::contrasting, ""},
               Field{"pixels_at_edges", &TemperatureImage::at_edges, ""},
               Field{"pixels_at_cold_end", &TemperatureImage::at_cold_end, "of the scale"},
               Field{"pixels_at_hot_end", &TemperatureImage::at_hot_end, ""},
               Field{"saturated_cold", &TemperatureImage::saturated_cold, "whether the scale ends too early"},
               Field{"saturated_hot", &TemperatureImage::saturated_hot, ""}};
inline constexpr auto kPictureStateOfColumns = std::tuple{Field{"columns", &ImageProfile::columns, "of pixels"},
                                                          Field{"empty_columns", &ImageProfile::empty_columns, ""}};
inline constexpr auto kPictureStateOfScale =
    std::tuple{Field{"scale_banded", &ColourScale::banded, ""},
               Field{"scale_step_degC", &ColourScale::step_degC, "to which temperatures are known"}};

template <>
inline constexpr auto kResult<PictureState> =
    ResultType{"PictureOfTemperature", "How a picture became temperatures along a spindle.",
               std::tuple_cat(fields_through(&PictureState::image, kPictureStateOfImage),
                              fields_through(&PictureState::columns, kPictureStateOfColumns),
                              fields_through(&PictureState::scale, kPictureStateOfScale),
                              std::tuple{Field{"three_areas", &PictureState::areas, ""}})};

// A value that a state may lack.
constexpr auto if_known(std::optional<double> ShaftState::*member) {
  return [member](const ShaftState& of) { return MayLack<double>{of.*member}; };
}

template <>
inline constexpr auto kResult<SensorPlace> = ResultType{
    "MeanPoint", "A place at which the temperature is its mean.",
    std::tuple{Field{"x_mm", [](const SensorPlace& of) { return Known<double>{of.point.x_mm}; }, ""},
               Field{"sigma_mm", &SensorPlace::sigma_mm, "null: not known"},
               Field{"slope_degC_per_mm", [](const SensorPlace& of) { return of.point.slope_degC_per_mm; }, ""},
               Field{"sigma_slope_degC_per_mm", &SensorPlace::sigma_slope_degC_per_mm, "null: not known"},
               Field{"misplaced_um_per_mm", &SensorPlace::misplaced_um_per_mm, "for each mm that the sensor is off"}}};

template <>
inline constexpr auto kResult<ShaftState> = ResultType{
    "MeanPointState", "Temperatures along a spindle, and their mean-value points.",
    std::tuple{Field{"name", &ShaftState::name, "the picture's file or the table's column"},
               Field{"length_mm", [](const ShaftState& of) { return length_mm(of.profile); }, ""},
               Field{"mean_degC", known(&ShaftState::mean_degC), "along the spindle"},
               Field{"sigma_mean_degC", &ShaftState::sigma_mean_degC, "null: not known"},
               Field{"elongation_um", if_known(&ShaftState::elongation_um), "since the start"},
               Field{"sigma_elongation_um", if_known(&ShaftState::sigma_elongation_um), ""},
               Field{"mean_points", &ShaftState::places, "the flattest first"},
               Field{"error_at_best_um", if_known(&ShaftState::error_at_best_um), "of a sensor at the best place"},
               Field{"picture", [](const ShaftState& of) { return MayLack<PictureState>{of.from}; }, "of a picture"}}};

inline constexpr std::tuple kBestPlace{Field{"x_mm", known(&BestPoint::x_mm), ""}};

template <>
inline constexpr auto kResult<BestPoint> = ResultType{
    "BestPoint", "One place for all states.",
    std::tuple_cat(kBestPlace, std::tuple{Field{"rms_um", &BestPoint::rms_um, "of what a sensor there tells wrong"},
                                          Field{"misplaced_um_per_mm", &BestPoint::misplaced_um_per_mm,
                                                "largest for each mm that the sensor is off"}})};

struct MeanPointsResult {
  std::string conclusion;
  double expansion_ppm_per_K = 0.0;
  std::optional<double> start_degC;
  MayLack<BestPoint> best;
  std::vector<ShaftState> states;
};

template <>
inline constexpr auto kResult<MeanPointsResult> = ResultType{
    "MeanPoints", "Where one sensor of temperature tells the elongation of a spindle.",
    std::tuple{Field{"conclusion", &MeanPointsResult::conclusion, "what it says in plain words"},
               Field{"expansion_ppm_per_K", &MeanPointsResult::expansion_ppm_per_K, "of the spindle"},
               Field{"start_degC", &MeanPointsResult::start_degC, "at which the elongation is 0; null: not given"},
               Field{"best", &MeanPointsResult::best, "of several states"},
               Field{"states", &MeanPointsResult::states, ""}}};

// What is drawn.
struct BestPlace {
  BestPoint best;
};

template <>
inline constexpr auto kResult<BestPlace> =
    ResultType{"BestPlace", "One place for all states.", fields_through(&BestPlace::best, kBestPlace)};

template <>
inline constexpr auto kResult<MeanPoint> = ResultType{"MeanPlace", "A place at which the temperature is its mean.",
                                                      std::tuple{Field{"x_mm", known(&MeanPoint::x_mm), ""}}};

struct DrawnShaft {
  ShaftState state;
};

template <>
inline constexpr auto kResult<DrawnShaft> = ResultType{
    "DrawnMeanPointState", "Temperature along a spindle, and where it is its mean.",
    std::tuple{
        Field{"name", [](const DrawnShaft& of) { return of.state.name; }, "the picture's file or the table's column"},
        Field{"mean_degC", [](const DrawnShaft& of) { return Known<double>{of.state.mean_degC}; }, ""},
        Field{"mean_points",
              [](const DrawnShaft& of) {
                std::vector<MeanPoint> points;
                for (const SensorPlace& place : of.state.places) points.push_back(place.point);
                return points;
              },
              ""},
        Field{"x_mm", [](const DrawnShaft& of) { return Known<std::vector<double>>{of.state.profile.x_mm}; }, "rising"},
        Field{"degC", [](const DrawnShaft& of) { return of.state.profile.degC; }, ""}}};

struct ShaftPart {
  std::string conclusion;
  MayLack<BestPlace> best;
  std::vector<DrawnShaft> states;
};

template <>
inline constexpr auto kResult<ShaftPart> = ResultType{
    "MeanPointPart", "Temperature along a spindle, and where it is its mean, as it is drawn.",
    std::tuple{Field{"conclusion", &ShaftPart::conclusion, ""},
               Field{"best", &ShaftPart::best, "one place for all states"}, Field{"states", &ShaftPart::states, ""}}};

}  // namespace ballbar
