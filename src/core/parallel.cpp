#include "core/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace windfall {

struct ThreadLimit::Control {
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : m_control(
          new Control{{tbb::global_control::max_allowed_parallelism,
                       static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency())}}) {
}
ThreadLimit::~ThreadLimit() = default;

void parallel_for_each(std::size_t count, const std::function<void(std::size_t)>& body) {
    if (count == 1) return body(0);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { body(i); });
}

void parallel_blocks(std::size_t count, std::size_t block,
                     const std::function<void(std::size_t, std::size_t)>& body) {
    const std::size_t blocks = (count + block - 1) / block;
    parallel_for_each(blocks, [&](std::size_t i) { body(i * block, std::min(count, (i + 1) * block)); });
}

double parallel_sum(std::size_t count, std::size_t block,
                    const std::function<double(std::size_t, std::size_t)>& body) {
    const std::size_t blocks = (count + block - 1) / block;
    std::vector<double> partial(blocks);
    parallel_for_each(blocks,
                      [&](std::size_t i) { partial[i] = body(i * block, std::min(count, (i + 1) * block)); });
    double sum = 0;
    for (const double value : partial) sum += value;
    return sum;
}

}  // namespace windfall
