// Results are in um: a target in another unit of length is converted where the data are opened.
#pragma once

#include <string>
#include <vector>

#include "model/model_options.hpp"

namespace ballbar {

// The data with the targets of the request, and their sigmas, in um: "z_mm" as z_um, with a remark. The old names still
// find them (Column::header). Other columns keep their unit. Throws Error where there is a z_um besides.
ModelData with_targets_in_um(ModelData data, const ModelOptions& options);

}  // namespace ballbar
