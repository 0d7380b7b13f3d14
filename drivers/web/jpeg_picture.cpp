#include "drivers/web/jpeg_picture.h"

#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

namespace tubesight::drivers {
namespace {

/// libjpeg reports errors by a call that must not return.
struct JpegErrors {
  jpeg_error_mgr manager{};
  std::jmp_buf out{};
};

void leave(j_common_ptr picture) {
  std::longjmp(reinterpret_cast<JpegErrors*>(picture->err)->out, 1);
}

void say_nothing(j_common_ptr /*picture*/) {}

/// Nothing with a destructor lives here: errors jump over it.
bool encode(jpeg_compress_struct& jpeg, JpegErrors& errors, const core::ImageView& grey,
            int quality, unsigned char** bytes, unsigned long* size) {
  if (setjmp(errors.out) != 0) {
    return false;
  }
  jpeg_create_compress(&jpeg);
  jpeg_mem_dest(&jpeg, bytes, size);
  jpeg.image_width = static_cast<JDIMENSION>(grey.width_px);
  jpeg.image_height = static_cast<JDIMENSION>(grey.height_px);
  jpeg.input_components = 1;
  jpeg.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  jpeg.dct_method = JDCT_IFAST;
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    auto* line = const_cast<JSAMPROW>(grey.line(static_cast<std::int32_t>(jpeg.next_scanline)));
    jpeg_write_scanlines(&jpeg, &line, 1);
  }
  jpeg_finish_compress(&jpeg);
  return true;
}

}  // namespace

std::string jpeg_of(const core::ImageView& grey, int quality) {
  JpegErrors errors;
  jpeg_compress_struct jpeg{};
  jpeg.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = leave;
  errors.manager.output_message = say_nothing;
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const bool good = encode(jpeg, errors, grey, quality, &bytes, &size);
  jpeg_destroy_compress(&jpeg);
  std::string made;
  if (good) {
    made.assign(reinterpret_cast<const char*>(bytes), size);
  }
  std::free(bytes);
  return made;
}

}  // namespace tubesight::drivers
