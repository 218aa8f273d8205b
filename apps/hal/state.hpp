// What a compensator knows, for the next start of the component: JSON.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/compensation.hpp"

namespace ballbar::hal {

std::string write_state(const Compensator& compensator);

// `name` stands in messages. Throws Error with it: what is not such a state, or that of another model or resolution.
void resume(Compensator& compensator, std::string_view bytes, const std::string& name);

}  // namespace ballbar::hal
