/// Decodes a film, for tests that look at it: prints "WIDTH HEIGHT FRAMES SECONDS CODEC" and writes all frames, red,
/// green and blue of each pixel from the top left, one after the other.
///
///     film_frames FILM RAW

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

namespace {

int must(int result, const char* what) {
  if (result >= 0) return result;
  std::fprintf(stderr, "%s fails: %d\n", what, result);
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "film_frames FILM RAW\n"), 2;
  AVFormatContext* format = nullptr;
  must(avformat_open_input(&format, argv[1], nullptr, nullptr), "opening");
  must(avformat_find_stream_info(format, nullptr), "looking for streams");
  const int index = must(av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0), "looking for a film");
  const AVStream* const stream = format->streams[index];
  const AVCodec* const codec = avcodec_find_decoder(stream->codecpar->codec_id);
  AVCodecContext* decoder = avcodec_alloc_context3(codec);
  must(avcodec_parameters_to_context(decoder, stream->codecpar), "its parameters");
  must(avcodec_open2(decoder, codec, nullptr), "opening the decoder");
  std::ofstream raw(argv[2], std::ios::binary);
  AVFrame* frame = av_frame_alloc();
  AVPacket* packet = av_packet_alloc();
  SwsContext* colors = nullptr;
  int frames = 0;
  std::int64_t end = 0;  ///< of the last frame
  std::vector<unsigned char> rgb;
  const auto take = [&] {
    while (avcodec_receive_frame(decoder, frame) == 0) {
      const int width = frame->width, height = frame->height;
      if (!colors) {
        colors =
            sws_getContext(width, height, static_cast<AVPixelFormat>(frame->format), width, height, AV_PIX_FMT_RGB24,
                           SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT, nullptr, nullptr, nullptr);
        // The file says which colours it means.
        if (frame->colorspace == AVCOL_SPC_BT709)
          must(sws_setColorspaceDetails(colors, sws_getCoefficients(SWS_CS_ITU709), 0,
                                        sws_getCoefficients(SWS_CS_ITU709), 1, 0, 1 << 16, 1 << 16),
               "its colours");
      }
      rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
      unsigned char* const rows[] = {rgb.data()};
      const int strides[] = {3 * width};
      must(sws_scale(colors, frame->data, frame->linesize, 0, height, rows, strides), "its colours");
      raw.write(reinterpret_cast<const char*>(rgb.data()), static_cast<std::streamsize>(rgb.size()));
      ++frames;
    }
  };
  while (av_read_frame(format, packet) == 0) {
    if (packet->stream_index == index) {
      end = std::max(end, packet->pts + packet->duration);
      must(avcodec_send_packet(decoder, packet), "decoding");
      take();
    }
    av_packet_unref(packet);
  }
  must(avcodec_send_packet(decoder, nullptr), "decoding");
  take();
  const std::int64_t start = stream->start_time == AV_NOPTS_VALUE ? 0 : stream->start_time;
  std::printf("%d %d %d %.6f %s\n", decoder->width, decoder->height, frames,
              static_cast<double>(end - start) * av_q2d(stream->time_base), codec->name);
  raw.flush();
  return raw ? 0 : 1;
}
