// What `compensate --from-picture --json` prints, and the part of a page that `--plot` draws.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/results/message.hpp"
#include "ballbar/formats/results/result_type.hpp"
#include "shaft_picture/shaft_picture.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<ThreeAreas> =
    ResultType("ThreeAreas", "A hot, a middle and a cold area of a picture, by thresholds of its colours.",
               Field{"mean_degC", known(&ThreeAreas::mean_degC), "by the three areas"},
               Field{"otsu_mean_degC", &ThreeAreas::otsu_mean_degC, "the same by Otsu's thresholds alone"},
               Field{"hot_pixels", &ThreeAreas::hot}, Field{"middle_pixels", &ThreeAreas::middle},
               Field{"cold_pixels", &ThreeAreas::cold}, Field{"hot_share", &ThreeAreas::hot_share},
               Field{"middle_share", &ThreeAreas::middle_share}, Field{"cold_share", &ThreeAreas::cold_share},
               Field{"red_otsu", &ThreeAreas::red_otsu, "threshold"}, Field{"red_triangle", &ThreeAreas::red_triangle},
               Field{"blue_otsu", &ThreeAreas::blue_otsu}, Field{"blue_triangle", &ThreeAreas::blue_triangle});

inline std::vector<std::size_t> corners_of(const PixelBox& of) { return {of.x, of.y, of.width, of.height}; }
constexpr auto of_image(auto... get) { return in(&PictureState::image, get...); }

template <>
inline constexpr auto kResult<PictureState> = ResultType(
    "PictureOfTemperature", "How a picture became temperatures along a spindle.",
    Field{"region", of_image(&TemperatureImage::region, &corners_of), "x, y, width, height, pixels"},
    Field{"pixels_used", of_image(&TemperatureImage::used)},
    Field{"pixels_off_scale", of_image(&TemperatureImage::off_scale)},
    Field{"pixels_contrasting", of_image(&TemperatureImage::contrasting)},
    Field{"pixels_at_edges", of_image(&TemperatureImage::at_edges)},
    Field{"pixels_at_cold_end", of_image(&TemperatureImage::at_cold_end), "of the scale"},
    Field{"pixels_at_hot_end", of_image(&TemperatureImage::at_hot_end)},
    Field{"saturated_cold", of_image(&TemperatureImage::saturated_cold), "whether the scale ends too early"},
    Field{"saturated_hot", of_image(&TemperatureImage::saturated_hot)},
    Field{"columns", in(&PictureState::columns, &ImageProfile::columns), "of pixels"},
    Field{"empty_columns", in(&PictureState::columns, &ImageProfile::empty_columns)},
    Field{"scale_banded", in(&PictureState::scale, &ColourScale::banded)},
    Field{"scale_step_degC", in(&PictureState::scale, &ColourScale::step_degC), "to which temperatures are known"},
    Field{"three_areas", &PictureState::areas});

template <>
inline constexpr auto kResult<SensorPlace> =
    ResultType("MeanPoint", "A place at which the temperature is its mean.",
               Field{"x_mm", known(in(&SensorPlace::point, &MeanPoint::x_mm))},
               Field{"sigma_mm", &SensorPlace::sigma_mm, "null: not known"},
               Field{"slope_degC_per_mm", in(&SensorPlace::point, &MeanPoint::slope_degC_per_mm)},
               Field{"sigma_slope_degC_per_mm", &SensorPlace::sigma_slope_degC_per_mm, "null: not known"},
               Field{"misplaced_um_per_mm", &SensorPlace::misplaced_um_per_mm, "for each mm that the sensor is off"});

template <>
inline constexpr auto kResult<ShaftState> =
    ResultType("MeanPointState", "Temperatures along a spindle, and their mean-value points.",
               Field{"name", &ShaftState::name, "the picture's file or the table's column"},
               Field{"length_mm", in(&ShaftState::profile, &length_mm)},
               Field{"mean_degC", known(&ShaftState::mean_degC), "along the spindle"},
               Field{"sigma_mean_degC", &ShaftState::sigma_mean_degC, "null: not known"},
               Field{"elongation_um", may_lack(&ShaftState::elongation_um), "since the start"},
               Field{"sigma_elongation_um", may_lack(&ShaftState::sigma_elongation_um)},
               Field{"mean_points", &ShaftState::places, "the flattest first"},
               Field{"error_at_best_um", may_lack(&ShaftState::error_at_best_um), "of a sensor at the best place"},
               Field{"picture", may_lack(&ShaftState::from), "of a picture"});

template <>
inline constexpr auto kResult<BestPoint> = ResultType(
    "BestPoint", "One place for all states.", Field{"x_mm", known(&BestPoint::x_mm)},
    Field{"rms_um", &BestPoint::rms_um, "of what a sensor there tells wrong"},
    Field{"misplaced_um_per_mm", &BestPoint::misplaced_um_per_mm, "largest for each mm that the sensor is off"});

struct MeanPointsResult {
  Paragraph conclusion;
  double expansion_ppm_per_K = 0.0;
  std::optional<double> start_degC;
  std::optional<BestPoint> best;
  std::vector<ShaftState> states;
};

template <>
inline constexpr auto kResult<MeanPointsResult> = ResultType(
    "MeanPoints", "Where one sensor of temperature tells the elongation of a spindle.",
    Field{"conclusion", &MeanPointsResult::conclusion, "what it says in plain words"},
    Field{"expansion_ppm_per_K", &MeanPointsResult::expansion_ppm_per_K, "of the spindle"},
    Field{"start_degC", &MeanPointsResult::start_degC, "at which the elongation is 0; null: not given"},
    Field{"best", may_lack(&MeanPointsResult::best), "of several states"}, Field{"states", &MeanPointsResult::states});

// What is drawn.
struct DrawnShaft {
  ShaftState state;
};

template <>
inline constexpr auto kResult<DrawnShaft> = ResultType(
    "DrawnMeanPointState", "Temperature along a spindle, and where it is its mean.", fields_of(&DrawnShaft::state),
    Field{"x_mm", known(in(&DrawnShaft::state, &ShaftState::profile, &TemperatureProfile::x_mm)), "rising"},
    Field{"degC", in(&DrawnShaft::state, &ShaftState::profile, &TemperatureProfile::degC)});

struct ShaftPart {
  Paragraph conclusion;
  std::optional<BestPoint> best;
  std::vector<DrawnShaft> states;
};

template <>
inline constexpr auto kResult<ShaftPart> = ResultType(
    "MeanPointPart", "Temperature along a spindle, and where it is its mean, as it is drawn.",
    Field{"conclusion", &ShaftPart::conclusion, "what it says in plain words"},
    Field{"best", may_lack(&ShaftPart::best), "one place for all states"}, Field{"states", &ShaftPart::states});

}  // namespace ballbar
