//! Structs, field by field: the macro that writes their impls, and what these call.

use core::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};

use super::{Read, Serial};

/// `Serialize`, `Deserialize` and [`Serial`] of a struct, from its fields with their names.
#[doc(hidden)]
#[macro_export]
macro_rules! serialised {
    ($name:ident { $($field:ident: $text:literal),* }) => {
        impl<T: $crate::serial::Number> $crate::serde::Serialize for $name<T> {
            fn serialize<S: $crate::serde::Serializer>(&self, serializer: S) -> ::core::result::Result<S::Ok, S::Error> {
                const FIELDS: &[&str] = &[$($text),*];
                let fields = $crate::serde::Serializer::serialize_struct(serializer, stringify!($name), FIELDS.len())?;
                $crate::serialised!(@write self fields $($field: $text),*)
            }
        }

        impl<'de, T: $crate::serial::Number> $crate::serde::Deserialize<'de> for $name<T> {
            fn deserialize<D: $crate::serde::Deserializer<'de>>(deserializer: D) -> ::core::result::Result<Self, D::Error> {
                const FIELDS: &[&str] = &[$($text),*];
                struct Fields<T>(::core::marker::PhantomData<T>);

                impl<'de, T: $crate::serial::Number> $crate::serde::de::Visitor<'de> for Fields<T> {
                    type Value = $name<T>;

                    fn expecting(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                        f.write_str(concat!("struct ", stringify!($name)))
                    }

                    fn visit_seq<A>(self, list: A) -> ::core::result::Result<Self::Value, A::Error>
                    where
                        A: $crate::serde::de::SeqAccess<'de>,
                    {
                        $crate::serialised!(@sequence self list $name $($field),*)
                    }

                    fn visit_map<A>(self, mut map: A) -> ::core::result::Result<Self::Value, A::Error>
                    where
                        A: $crate::serde::de::MapAccess<'de>,
                    {
                        $(let mut $field = ::core::option::Option::None;)*
                        while let ::core::option::Option::Some(name) = map.next_key_seed($crate::serial::Name(FIELDS))? {
                            match name {
                                $($text => $crate::serial::once::<_, T, A>($text, &mut $field, &mut map)?,)*
                                _ => {}
                            }
                        }
                        $($crate::serialised!(@there $field $text);)*
                        ::core::result::Result::Ok($crate::serialised!(@value $name $($field),*))
                    }
                }

                let fields = Fields(::core::marker::PhantomData);
                $crate::serde::Deserializer::deserialize_struct(deserializer, stringify!($name), FIELDS, fields)
            }
        }

        impl<T: $crate::serial::Number> $crate::serial::Serial<T> for $name<T> {
            fn write<S: $crate::serde::Serializer>(&self, serializer: S) -> ::core::result::Result<S::Ok, S::Error> {
                $crate::serde::Serialize::serialize(self, serializer)
            }

            fn read<'de, D: $crate::serde::Deserializer<'de>>(deserializer: D) -> ::core::result::Result<Self, D::Error> {
                $crate::serde::Deserialize::deserialize(deserializer)
            }
        }
    };
    (@write $self:ident $fields:ident) => {
        $crate::serde::ser::SerializeStruct::end($fields)
    };
    (@write $self:ident $fields:ident $($field:ident: $text:literal),+) => {{
        let mut fields = $fields;
        $(
            let value = $crate::serial::Written::<_, T>::new(&$self.$field);
            $crate::serde::ser::SerializeStruct::serialize_field(&mut fields, $text, &value)?;
        )+
        $crate::serde::ser::SerializeStruct::end(fields)
    }};
    (@sequence $self:ident $list:ident $name:ident) => {{
        let _ = $list;
        ::core::result::Result::Ok($name::default())
    }};
    (@sequence $self:ident $list:ident $name:ident $($field:ident),+) => {{
        let (mut list, mut count) = ($list, 0);
        $(let $field = $crate::serial::element::<_, T, A>(&mut list, &mut count, &$self)?;)+
        ::core::result::Result::Ok($name { $($field),+ })
    }};
    (@there $field:ident $text:literal) => {
        let $field = $crate::serial::there($text, $field)?;
    };
    (@value $name:ident) => { $name::default() };
    (@value $name:ident $($field:ident),+) => { $name { $($field),+ } };
}

/// The next element of a sequence, which is number `count`.
///
/// # Errors
///
/// Where the sequence ends before it.
pub fn element<'de, V, T, A>(list: &mut A, count: &mut usize, all: &impl Visitor<'de>) -> Result<V, A::Error>
where
    V: Serial<T>,
    A: SeqAccess<'de>,
{
    let found = list.next_element::<Read<V, T>>()?.ok_or_else(|| A::Error::invalid_length(*count, all))?;
    *count += 1;
    Ok(found.value)
}

/// The value of a field that has just been named.
///
/// # Errors
///
/// Where it has a value already.
pub fn once<'de, V, T, A>(name: &'static str, field: &mut Option<V>, map: &mut A) -> Result<(), A::Error>
where
    V: Serial<T>,
    A: MapAccess<'de>,
{
    if field.is_some() {
        return Err(A::Error::duplicate_field(name));
    }
    *field = Some(map.next_value::<Read<V, T>>()?.value);
    Ok(())
}

/// A field once all are read.
///
/// # Errors
///
/// Where it was not among them.
pub fn there<V, E: Error>(name: &'static str, field: Option<V>) -> Result<V, E> {
    field.ok_or_else(|| E::missing_field(name))
}

/// Reads the name of one of these fields; formats that count fields instead have its number.
pub struct Name(pub &'static [&'static str]);

impl<'de> DeserializeSeed<'de> for Name {
    type Value = &'static str;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<&'static str, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl<'de> Visitor<'de> for Name {
    type Value = &'static str;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a field")
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<&'static str, E> {
        let name = usize::try_from(number).ok().and_then(|number| self.0.get(number));
        name.copied().ok_or_else(|| E::invalid_value(serde::de::Unexpected::Unsigned(number), &self))
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<&'static str, E> {
        let known = self.0.iter().find(|known| **known == name);
        known.copied().ok_or_else(|| E::unknown_field(name, self.0))
    }

    fn visit_bytes<E: Error>(self, name: &[u8]) -> Result<&'static str, E> {
        let known = self.0.iter().find(|known| known.as_bytes() == name);
        known.copied().ok_or_else(|| E::invalid_value(serde::de::Unexpected::Bytes(name), &self))
    }
}
