#include "recipe/dressing.h"

#include <memory>

#include "decay/dressing.h"

namespace windfall::recipe {

std::function<void(take::Frame&)> dressing(const take::TakeReader& take) {
    if (take.info().process != "decay") return {};
    const auto shared = std::make_shared<decay::Dressing>(take.meshes(), take.info());
    return [shared](take::Frame& frame) { shared->dress(frame); };
}

}  // namespace windfall::recipe
