multibody::multibody! {
    /// A force reads an output, which reads another; `mass` is a name of the language's fields, `far` is for one choice alone.
    pub mod buffer {
        body block { mass: 2.0 }
        joint slide: Prismatic { parent: ground, child: block, axis: X }
        output stretch = slide.travel - reach;
        output reach = 0.1 * cos(t);
        output far = slide.travel;
        force spring: Effort { joint: slide, value: -100.0 * stretch }
    }
}
