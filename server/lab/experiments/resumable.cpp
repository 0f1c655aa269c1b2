#include "server/lab/experiments/resumable.hpp"

#include <cstdio>
#include <thread>

#include <opencv2/core.hpp>

namespace seeker::lab {

void run_in_threads(int jobs, const std::function<void()>& work) {
  // Threads run whole robots; OpenCV's own would only fight with them.
  const int threads_before = cv::getNumThreads();
  cv::setNumThreads(1);
  std::vector<std::thread> workers;
  workers.reserve(static_cast<std::size_t>(jobs));
  for (int n = 1; n < jobs; ++n) {
    workers.emplace_back(work);
  }
  work();
  for (std::thread& worker : workers) {
    worker.join();
  }
  cv::setNumThreads(threads_before);
}

void print_progress(const std::string& text) {
  if (text.empty()) {
    std::fputs("\n", stderr);
  } else {
    std::fprintf(stderr, "\r\033[K%s", text.c_str());
  }
}

}  // namespace seeker::lab
