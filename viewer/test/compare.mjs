// How far two pictures differ, as a page of the browser decodes them.

/** A channel that differs by so much is another colour. */
const COLOUR = 40;

/** The part of the squares of so many pixels whose mean colours differ; all where the sizes do. */
export const difference = (page, a, b, square = 1) =>
  page.evaluate(
    async ([a, b, colour, square]) => {
      const means = async (url) => {
        const image = new Image();
        image.src = url;
        await image.decode();
        const [width, height] = [image.width, image.height].map((side) => Math.ceil(side / square));
        const sheet = new OffscreenCanvas(width, height);
        const sketch = sheet.getContext("2d");
        [sketch.imageSmoothingEnabled, sketch.imageSmoothingQuality] = [square > 1, "high"];
        sketch.drawImage(image, 0, 0, width, height);
        return { size: [image.width, image.height].join(), data: sketch.getImageData(0, 0, width, height).data };
      };
      const [one, other] = await Promise.all([a, b].map(means));
      if (one.size !== other.size) return 1;
      let count = 0;
      for (let i = 0; i < one.data.length; i += 4) {
        if ([0, 1, 2].some((k) => Math.abs(one.data[i + k] - other.data[i + k]) > colour)) count++;
      }
      return (4 * count) / one.data.length;
    },
    [a, b, COLOUR, square],
  );

export const urlOf = (bytes, type = "png") => `data:image/${type};base64,${bytes.toString("base64")}`;
