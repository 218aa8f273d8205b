// Batches one after the other as one series, so that a model of effects can be fitted to all of them at once.
#pragma once

#include <span>

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Each batch begins where effects begin: its temperatures are rises on those of its first row, 10 days after the batch
// before, in which the machine stands still, as warm as at the start. In these days nothing is measured (gaps of the
// target). What a machine remembers from before a batch is not known and taken as nothing. Only the columns of the
// model are kept. At least one batch; throws Error where a batch lacks a column.
Series joined_batches(std::span<const Series> batches, const Model& model);

}  // namespace ballbar
