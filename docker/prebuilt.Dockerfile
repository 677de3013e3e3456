# As programs.Dockerfile, of programs that have been built on a Debian 12 already:
#   docker build -t osteomill-programs -f docker/prebuilt.Dockerfile build/release/bin
FROM scratch
COPY haptic_server packet_replay render_client /
