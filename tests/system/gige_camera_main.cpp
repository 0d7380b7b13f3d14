// A GigE Vision camera on the loopback, made by the library that the driver is tested with: shows
// the pictures of a file.
//
// Usage: gige_camera ADDRESS SERIAL FILE WIDTH HEIGHT LEAD LOST_RATIO
//
// FILE holds pictures of WIDTH x HEIGHT grey bytes, one behind the other. The first is shown LEAD
// times more, the last for ever. LOST_RATIO is that of packets. Lives until it is killed.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include <arv.h>
#include <unistd.h>

namespace {

struct Show {
  std::vector<char> pictures;
  std::size_t bytes_a_picture = 0;
  std::size_t lead = 0;
  std::size_t shown = 0;
};

/// On the camera's thread. A buffer says its size only once it was sent.
void show_next(ArvBuffer* buffer, void* data, guint32 /*exposure_us*/, guint32 /*gain*/,
               ArvPixelFormat format) {
  Show& show = *static_cast<Show*>(data);
  const std::size_t last = show.pictures.size() / show.bytes_a_picture - 1;
  const std::size_t wanted = show.shown > show.lead ? show.shown - show.lead : 0;
  ++show.shown;
  std::size_t size = 0;
  auto* const to = static_cast<char*>(const_cast<void*>(arv_buffer_get_data(buffer, &size)));
  const int width = arv_buffer_get_image_width(buffer);
  const int height = arv_buffer_get_image_height(buffer);
  const auto bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (format == ARV_PIXEL_FORMAT_MONO_8 && bytes == show.bytes_a_picture) {
    std::memcpy(to, show.pictures.data() + std::min(wanted, last) * bytes, bytes);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 8) {
    std::fprintf(stderr, "gige_camera: 7 arguments, see its source\n");
    return 2;
  }
  static Show show;
  std::ifstream file(arguments[3], std::ios::binary);
  show.pictures.assign(std::istreambuf_iterator<char>(file), {});
  show.bytes_a_picture = static_cast<std::size_t>(std::atoi(arguments[4])) *
                         static_cast<std::size_t>(std::atoi(arguments[5]));
  show.lead = static_cast<std::size_t>(std::atoi(arguments[6]));
  if (show.bytes_a_picture == 0 || show.pictures.size() < show.bytes_a_picture) {
    std::fprintf(stderr, "gige_camera: no pictures in %s\n", arguments[3]);
    return 2;
  }
  ArvGvFakeCamera* const camera = arv_gv_fake_camera_new_full(arguments[1], arguments[2], nullptr);
  if (camera == nullptr || arv_gv_fake_camera_is_running(camera) == FALSE) {
    std::fprintf(stderr, "gige_camera: cannot be at %s\n", arguments[1]);
    return 1;
  }
  g_object_set(camera, "gvsp-lost-ratio", std::atof(arguments[7]), nullptr);
  arv_fake_camera_set_fill_pattern(arv_gv_fake_camera_get_fake_camera(camera), show_next, &show);
  std::puts("ready");
  std::fflush(stdout);
  while (true) {
    pause();
  }
}
