# render_client, of the project's Debian package, drawing offscreen on the processor: docker/build_images.sh
# BASE: the Debian that the packages are for.
ARG BASE=debian:trixie-slim
FROM ${BASE}
ARG DEBIAN_FRONTEND=noninteractive
COPY osteomill-client_*.deb /packages/
RUN apt-get update -qq \
    && apt-get install -y -qq --no-install-recommends /packages/*.deb \
    && rm -rf /var/lib/apt/lists/* /packages \
    && useradd --uid 10001 --home-dir /tmp lab \
    && install -d -o lab /out
COPY is_connected.sh /usr/local/bin/
USER lab
WORKDIR /out
HEALTHCHECK --interval=5s --timeout=3s --start-period=30s --retries=3 CMD is_connected.sh 7010
ENTRYPOINT ["render_client"]
CMD ["--connect", "server:7010", "--offscreen", "--frames", "100000", "--screenshots", "/out/frames"]
