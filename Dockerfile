# docker build -t plumbline . && docker run --rm -v "$PWD:/work" plumbline run scene.prm
FROM debian:12 AS build
COPY . /plumbline
RUN /plumbline/bootstrap package

FROM debian:12
COPY --from=build /plumbline/build/package/plumbline_*.deb /tmp/
RUN apt-get update \
 && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends /tmp/plumbline_*.deb \
 && rm -rf /tmp/plumbline_*.deb /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["plumbline"]
