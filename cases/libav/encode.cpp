/// Detail of cases/film/module.hpp: the entry of the library, and films by libav.

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <cstring>

#include "cases/film/module.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// What a format is made with. The numbers are those at which thin lines and texts of our pictures stay clean.
struct Recipe {
  const char *container, *encoder;
  AVPixelFormat pixels;
  const char* options[4][2];
};

Recipe recipeOf(FilmFormat format) {
  switch (format) {
    case FilmFormat::mp4:
      return {"mp4",
              "libx264",
              AV_PIX_FMT_YUV420P,
              {{"crf", "18"}, {"preset", "medium"}, {"tune", "animation"}, {"profile", "high"}}};
    case FilmFormat::webm:
      return {"webm", "libvpx-vp9", AV_PIX_FMT_YUV420P, {{"crf", "24"}, {"deadline", "good"}, {"cpu-used", "4"}, {}}};
    case FilmFormat::gif:
      return {"gif", "gif", AV_PIX_FMT_PAL8, {}};
  }
  throw RunError("there is no such format of films");
}

int must(int result, const char* what) {
  if (result >= 0) return result;
  char why[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(result, why, sizeof why);
  throw RunError(std::string("the film cannot be written: ") + what + ": " + why);
}

template <class T>
T* made(T* pointer, const char* what) {
  if (!pointer) throw RunError(std::string("the film cannot be written: libav gives no ") + what);
  return pointer;
}

struct Free {
  void operator()(AVCodecContext* c) const { avcodec_free_context(&c); }
  void operator()(AVFrame* f) const { av_frame_free(&f); }
  void operator()(AVPacket* p) const { av_packet_free(&p); }
  void operator()(SwsContext* s) const { sws_freeContext(s); }
  void operator()(AVFormatContext* f) const {
    if (f->pb) {
      std::uint8_t* rest = nullptr;
      avio_close_dyn_buf(f->pb, &rest);
      av_free(rest);
    }
    avformat_free_context(f);
  }
};

class Encoder : public FilmEncoder {
 public:
  explicit Encoder(const FilmShape& shape) : shape_(shape) {
    const Recipe recipe = recipeOf(shape.format);
    const AVCodec* const codec =
        made(avcodec_find_encoder_by_name(recipe.encoder), (std::string("encoder ") + recipe.encoder).c_str());
    AVFormatContext* format = nullptr;
    must(avformat_alloc_output_context2(&format, nullptr, recipe.container, nullptr), "its container");
    format_.reset(format);
    format->flags |= AVFMT_FLAG_BITEXACT;
    codec_.reset(made(avcodec_alloc_context3(codec), "context"));
    codec_->width = shape.width, codec_->height = shape.height;
    codec_->pix_fmt = recipe.pixels;
    codec_->framerate = av_d2q(shape.fps, 1000);
    codec_->time_base = av_inv_q(codec_->framerate);
    codec_->thread_count = 1;  // the same bytes with any number of cores
    codec_->flags |= AV_CODEC_FLAG_BITEXACT;
    if (shape.format != FilmFormat::gif) {
      codec_->color_range = AVCOL_RANGE_MPEG;
      codec_->colorspace = AVCOL_SPC_BT709;
      codec_->color_primaries = AVCOL_PRI_BT709;
      codec_->color_trc = AVCOL_TRC_BT709;
    }
    if (format->oformat->flags & AVFMT_GLOBALHEADER) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    for (const auto& [key, value] : recipe.options)
      if (key) must(av_opt_set(codec_->priv_data, key, value, 0), key);
    must(avcodec_open2(codec_.get(), codec, nullptr), recipe.encoder);
    stream_ = made(avformat_new_stream(format, nullptr), "stream");
    stream_->time_base = codec_->time_base;
    stream_->avg_frame_rate = codec_->framerate;
    must(avcodec_parameters_from_context(stream_->codecpar, codec_.get()), "its stream");
    must(avio_open_dyn_buf(&format->pb), "memory");
    must(avformat_write_header(format, nullptr), "its header");
    packet_.reset(made(av_packet_alloc(), "packet"));
    frame_.reset(made(av_frame_alloc(), "frame"));
    frame_->format = recipe.pixels, frame_->width = shape.width, frame_->height = shape.height;
    must(av_frame_get_buffer(frame_.get(), 0), "memory of a frame");
    if (shape.format == FilmFormat::gif) return;
    // The whole range of red, green and blue to the usual one of BT.709, colours by the mean of 2 x 2 pixels.
    scale_.reset(
        made(sws_getContext(shape.width, shape.height, AV_PIX_FMT_RGB24, shape.width, shape.height, recipe.pixels,
                            SWS_AREA | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP, nullptr, nullptr, nullptr),
             "conversion of colours"));
    must(sws_setColorspaceDetails(scale_.get(), sws_getCoefficients(SWS_CS_ITU709), 1,
                                  sws_getCoefficients(SWS_CS_ITU709), 0, 0, 1 << 16, 1 << 16),
         "its colours");
  }

  void add(const unsigned char* pixels) override {
    must(av_frame_make_writable(frame_.get()), "memory of a frame");
    if (scale_) {
      const unsigned char* const rows[] = {pixels};
      const int strides[] = {3 * shape_.width};
      must(sws_scale(scale_.get(), rows, strides, 0, shape_.height, frame_->data, frame_->linesize), "its colours");
    } else {
      for (int y = 0; y < shape_.height; ++y)
        std::memcpy(frame_->data[0] + static_cast<std::ptrdiff_t>(y) * frame_->linesize[0],
                    pixels + static_cast<std::ptrdiff_t>(y) * shape_.width, static_cast<std::size_t>(shape_.width));
      std::memcpy(frame_->data[1], shape_.palette.data(), sizeof shape_.palette);
    }
    frame_->pts = count_++;
    send(frame_.get());
  }

  std::string finish() override {
    send(nullptr);
    must(av_write_trailer(format_.get()), "its end");
    std::uint8_t* bytes = nullptr;
    const int size = avio_close_dyn_buf(format_->pb, &bytes);
    format_->pb = nullptr;
    const std::string out(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
    av_free(bytes);
    return out;
  }

 private:
  /// A frame, or null at the end; writes what comes of it.
  void send(const AVFrame* frame) {
    must(avcodec_send_frame(codec_.get(), frame), "a frame");
    while (true) {
      const int result = avcodec_receive_packet(codec_.get(), packet_.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
      must(result, "a frame");
      if (packet_->duration == 0) packet_->duration = 1;
      av_packet_rescale_ts(packet_.get(), codec_->time_base, stream_->time_base);
      packet_->stream_index = 0;
      must(av_interleaved_write_frame(format_.get(), packet_.get()), "a frame");
    }
  }

  FilmShape shape_;
  std::unique_ptr<AVFormatContext, Free> format_;
  std::unique_ptr<AVCodecContext, Free> codec_;
  std::unique_ptr<AVFrame, Free> frame_;
  std::unique_ptr<AVPacket, Free> packet_;
  std::unique_ptr<SwsContext, Free> scale_;
  AVStream* stream_ = nullptr;
  std::int64_t count_ = 0;
};

std::unique_ptr<FilmEncoder> open(const FilmShape& shape) {
  av_log_set_level(AV_LOG_QUIET);  // what fails says so by its result
  return std::make_unique<Encoder>(shape);
}

}  // namespace
}  // namespace gambeson

const gambeson::FilmModule* gambesonFilmModule() {
  static const gambeson::FilmModule module{gambeson::open};
  return &module;
}
